#include "stepper/contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode/geom/convert.hpp"

namespace supernormal::stepper {

void set_rows(System& system, Contact& contact, const Vector3& place, const Vector3& normal, const Vector3& along) {
  const Body& one = system.body1(contact);
  const Body& two = system.body2(contact);
  const Vector3 arm1 = place - one.centre();
  const Vector3 arm2 = place - two.centre();
  const Vector3 first = (along - along.dot(normal) * normal).normalized();
  const std::array<Vector3, 3> directions = {normal, first, normal.cross(first)};
  const auto set = [&](Row& row, const Vector3& direction, const Vector3& lever1, const Vector3& lever2) {
    row.direction = direction;
    row.lever1 = lever1;
    row.lever2 = lever2;
    row.response1 = one.world_inverse_inertia * lever1;
    row.response2 = two.world_inverse_inertia * lever2;
    row.mobility =
        direction.squaredNorm() * (one.inverse_mass + two.inverse_mass) + lever1.dot(row.response1) + lever2.dot(row.response2);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    set(contact.rows[k], directions[k], arm1.cross(directions[k]), arm2.cross(directions[k]));
  }
  if (Rolling* const torques = system.rolling_of(contact)) {
    for (std::size_t k = 0; k < 3; ++k) set((*torques)[k], Vector3::Zero(), directions[(k + 1) % 3], directions[(k + 1) % 3]);
  }
  // One mass for all directions across the normal, the smallest: then friction opposes the slip. The exact 2 x 2 solution, cut to
  // the friction cone, would not.
  const Row& u = contact.rows[1];
  const Row& v = contact.rows[2];
  const double mixed = u.lever1.dot(v.response1) + u.lever2.dot(v.response2);
  contact.tangent_mass = 1 / ((u.mobility + v.mobility) / 2 + std::hypot((u.mobility - v.mobility) / 2, mixed));
}

Contact contact_of(System& system, const dContact& given, const Surface& surface, int body1, int body2) {
  using ode::to_vector;
  Contact contact;
  contact.body1 = body1;
  contact.body2 = body2;
  contact.surface = &surface;
  contact.geom1 = given.geom.g1;
  contact.geom2 = given.geom.g2;
  contact.gap = -double{given.geom.depth};
  Body& one = system.body1(contact);
  Body& two = system.body2(contact);
  contact.size = std::numeric_limits<double>::infinity();
  for (Body* const body : {&one, &two}) {
    if (!body->is_dynamic()) continue;
    contact.size = std::min(contact.size, body->size);
    body->is_touched = true;
    body->is_borne = body->is_borne || contact.gap <= 0;
  }
  if (surface.rolls()) {
    contact.rolling = static_cast<int>(system.rolling.size());
    system.rolling.emplace_back();
  }
  const Vector3 place = to_vector(given.geom.pos);
  const Vector3 normal = to_vector(given.geom.normal).normalized();
  // If the first body is the world, ODE exchanges the bodies and reverses the normal, but not fdir1.
  const double sign = body1 == 0 ? -1 : 1;
  dVector3 facing, along, across;
  ode::from_vector(sign * normal, facing);
  dPlaneSpace(facing, along, across);
  set_rows(system, contact, place, normal, to_vector(surface.has_direction ? given.fdir1 : along));
  for (std::size_t k = 0; k < 3; ++k) contact.rows[k].motion = surface.motion[k];
  contact.rows[1].motion *= sign;
  contact.place1 = one.rotation.transpose() * (place - one.start);
  contact.place2 = two.rotation.transpose() * (place - two.start);
  return contact;
}

}  // namespace supernormal::stepper
