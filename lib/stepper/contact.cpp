#include "stepper/contact.hpp"

#include <algorithm>
#include <cmath>

#include "ode/geom/convert.hpp"
#include "ode/support/require.hpp"

namespace supernormal::stepper {
namespace {

/// Refuses a normal that is not of unit length, and numbers that are not finite.
void require_geometry(const dContact& contact) {
  const Vector3 normal = ode::require_finite("geom.normal", ode::to_vector(contact.geom.normal));
  require_unit("geom.normal", normal);
  ode::require_finite("geom.pos", ode::to_vector(contact.geom.pos));
  require_in("geom.depth", contact.geom.depth, -kLargest, kLargest, "m");
  if ((contact.surface.mode & dContactFDir1) == 0) return;
  const Vector3 direction = ode::require_finite("fdir1", ode::to_vector(contact.fdir1));
  require_in("length of fdir1 along the surface", (direction - direction.dot(normal) * normal).norm(), 1e-3, kLargest);
}

}  // namespace

Surface surface_of(const dContact& contact) {
  require_geometry(contact);
  const dSurfaceParameters& given = contact.surface;
  const auto has = [&](int flag) { return (given.mode & flag) != 0; };
  Surface surface;
  surface.has_direction = has(dContactFDir1);
  surface.friction[0] = {require_in("surface.mu", given.mu, 0, kAny), has(dContactApprox1_1)};
  surface.friction[1] = {has(dContactMu2) ? require_in("surface.mu2", given.mu2, 0, kAny) : double{given.mu},
                         has(dContactApprox1_2)};
  if (has(dContactRolling)) {
    // As in ODE, a negative limit is none.
    const auto limit = [](const char* name, double rho) { return std::max(0.0, require_in(name, rho, -kLargest, kAny)); };
    const double rho = limit("surface.rho", given.rho);
    surface.rolling[0] = {rho, has(dContactApprox1_1)};
    surface.rolling[1] = {has(dContactAxisDep) ? limit("surface.rho2", given.rho2) : rho, has(dContactApprox1_2)};
    surface.rolling[2] = {has(dContactAxisDep) ? limit("surface.rhoN", given.rhoN) : rho, has(dContactApprox1_N)};
  }
  const auto speed = [](const char* name, double value) { return require_in(name, value, -kLargest, kLargest, "m/s"); };
  if (has(dContactMotionN)) surface.motion[0] = speed("surface.motionN", given.motionN);
  if (has(dContactMotion1)) surface.motion[1] = speed("surface.motion1", given.motion1);
  if (has(dContactMotion2)) surface.motion[2] = speed("surface.motion2", given.motion2);
  if (has(dContactSlip1)) surface.slip[0] = require_in("surface.slip1", given.slip1, 0, kLargest, "m/(N s)");
  if (has(dContactSlip2)) surface.slip[1] = require_in("surface.slip2", given.slip2, 0, kLargest, "m/(N s)");
  if (has(dContactBounce)) {
    const double restitution = require_in("surface.bounce", given.bounce, 0, 1);
    surface.bounce_speed = speed("surface.bounce_vel", given.bounce_vel);
    if (surface.bounce_speed >= 0) surface.bounce = restitution;  // as in ODE, below 0 nothing bounces
  }
  if (has(dContactSoftERP)) surface.erp = require_in("surface.soft_erp", given.soft_erp, 0, 1);
  if (has(dContactSoftCFM)) surface.cfm = require_in("surface.soft_cfm", given.soft_cfm, 0, kLargest, "m/(N s)");
  return surface;
}

void set_rows(System& system, Contact& contact, const Vector3& place, const Vector3& normal, const Vector3& along) {
  contact.arm1 = place - system.body1(contact).centre();
  contact.arm2 = place - system.body2(contact).centre();
  const Vector3 first = (along - along.dot(normal) * normal).normalized();
  contact.rows[0].direction = normal;
  contact.rows[1].direction = first;
  contact.rows[2].direction = normal.cross(first);
  set_responses(system, contact);
}

void set_responses(System& system, Contact& contact) {
  const Body& one = system.body1(contact);
  const Body& two = system.body2(contact);
  for (Row& row : contact.rows) {
    row.set(row.direction, one, contact.arm1.cross(row.direction), two, contact.arm2.cross(row.direction));
    row.mobility += one.inverse_mass + two.inverse_mass;
  }
  if (Rolling* const torques = system.rolling_of(contact)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3& axis = contact.rows[(k + 1) % 3].direction;
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

Contact contact_of(System& system, const Given& given, double time) {
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
  // dCollide moves the place of a meeting back with the mean of both bodies, but each of them has its own way to it.
  const Body& one = system.body1(contact);
  const Body& two = system.body2(contact);
  const Vector3 velocity = one.velocity - two.velocity;
  const double approach = -normal.dot(velocity);
  if (contact.gap <= 0 || contact.gap > time * approach) return contact;
  const Vector3 way = contact.gap / approach / (one.inverse_mass + two.inverse_mass) * velocity;
  contact.arm1 -= two.inverse_mass * way;
  contact.arm2 += one.inverse_mass * way;
  set_responses(system, contact);
  return contact;
}

}  // namespace supernormal::stepper
