#include "stepper/surface.hpp"

#include <algorithm>

#include "ode/geom/convert.hpp"
#include "ode/support/require.hpp"
#include "stepper/row.hpp"

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

}  // namespace supernormal::stepper
