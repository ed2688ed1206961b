#include "stepper/contact.hpp"

#include <algorithm>
#include <cmath>

#include "ode/geom/convert.hpp"

namespace supernormal::stepper {

void set_rows(System& system, Contact& contact, const Vector3& place, const Vector3& normal, const Vector3& along) {
  const Body& one = system.body1(contact);
  const Body& two = system.body2(contact);
  contact.arm1 = place - one.centre();
  contact.arm2 = place - two.centre();
  const Vector3 first = (along - along.dot(normal) * normal).normalized();
  const std::array<Vector3, 3> directions = {normal, first, normal.cross(first)};
  for (std::size_t k = 0; k < 3; ++k) {
    contact.rows[k].set(directions[k], one, contact.arm1.cross(directions[k]), two, contact.arm2.cross(directions[k]));
    contact.rows[k].mobility += one.inverse_mass + two.inverse_mass;
  }
  if (Rolling* const torques = system.rolling_of(contact)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& axis = directions[(k + 1) % 3];
      (*torques)[k].set(axis, one, axis, two, axis);
    }
  }
  // One mass for all directions across the normal, the smallest: then friction opposes the slip. The exact 2 x 2 solution, cut to
  // the friction cone, would not.
  const Row& u = contact.rows[1];
  const Row& v = contact.rows[2];
  const double mixed = contact.arm1.cross(u.direction).dot(v.response1) + contact.arm2.cross(u.direction).dot(v.response2);
  contact.tangent_mass = 1 / ((u.mobility + v.mobility) / 2 + std::hypot((u.mobility - v.mobility) / 2, mixed));
}

Contact contact_of(System& system, const Given& given) {
  using ode::to_vector;
  const dContactGeom& geometry = given.contact.geom;
  Contact contact;
  contact.given = &given;
  contact.body1 = given.body1;
  contact.body2 = given.body2;
  contact.gap = contact.first_gap = -double{geometry.depth};
  contact.size = system.size(contact);
  for (Body* const body : {&system.body1(contact), &system.body2(contact)}) {
    if (!body->is_dynamic()) continue;
    body->is_touched = true;
    body->is_borne = body->is_borne || contact.gap <= 0;
  }
  if (given.surface.rolls()) {
    contact.rolling = static_cast<int>(system.rolling.size());
    system.rolling.emplace_back();
  }
  system.has_bounces = system.has_bounces || given.surface.bounce > 0;
  const Vector3 normal = to_vector(geometry.normal).normalized();
  // If the first body is the world, ODE exchanges the bodies and reverses the normal, but not fdir1.
  dVector3 facing, along, across;
  ode::from_vector((given.body1 == 0 ? -1 : 1) * normal, facing);
  dPlaneSpace(facing, along, across);
  set_rows(system, contact, to_vector(geometry.pos), normal, to_vector(given.surface.has_direction ? given.contact.fdir1 : along));
  return contact;
}

}  // namespace supernormal::stepper
