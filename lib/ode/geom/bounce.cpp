// A contact is a constraint on the velocity after the step, and this velocity moves the bodies. So bodies that bounce turn back
// where the step begins, and not where they touch. They turn back with the velocity that they would have there on their way back:
// on the parabola that leaves the place of touch with e times the velocity of touch. So they rise as high as if they had touched.
#include "ode/geom/bounce.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ode/geom/convert.hpp"
#include "ode/geom/motion.hpp"
#include "ode/support/require.hpp"

namespace supernormal::ode {
namespace {

dBodyID body_of(dGeomID geom) { return geom == nullptr ? nullptr : dGeomGetBody(geom); }

/// The relative motion of two bodies along the normal of their contact, at the start of a step.
struct Separation {
  double velocity;      // m/s, from the velocity of the surface
  double acceleration;  // m/s^2
  double load;          // m/s^2; the larger one of both bodies, which contacts with other bodies may hold up

  static Separation at(const dContact& contact, double of_surface) {
    const dBodyID body1 = body_of(contact.geom.g1), body2 = body_of(contact.geom.g2);
    const Vector3 normal = to_vector(contact.geom.normal), point = to_vector(contact.geom.pos);
    const double acceleration1 = normal.dot(acceleration_of(body1)), acceleration2 = normal.dot(acceleration_of(body2));
    return {normal.dot(velocity_at(body1, point) - velocity_at(body2, point)) - of_surface, acceleration1 - acceleration2,
            std::max(std::abs(acceleration1), std::abs(acceleration2))};
  }
};

/// m/s; the separating velocity after the step, if the surface's restitution makes the bodies bounce in it.
std::optional<double> find_bounce(const dContact& contact, const Separation& now, double step) {
  const dSurfaceParameters& surface = contact.surface;
  const double restitution = require_in("surface.bounce", surface.bounce, 0, 1);
  if (!(surface.bounce_vel >= 0 && -now.velocity > double{surface.bounce_vel})) return std::nullopt;
  const double gap = std::max(0.0, -double{contact.geom.depth});
  const auto touch = find_touch(gap, now.velocity, now.acceleration, step);
  if (!touch) return std::nullopt;
  const double leaving = restitution * touch->speed;
  const double square = leaving * leaving + 2 * now.acceleration * gap;
  // No velocity is right if a body rises less than it is high.
  if (!is_impact(touch->speed, restitution, now.load, step) || !(square >= 0)) return std::nullopt;
  return std::sqrt(square) + now.acceleration * step / 2;
}

}  // namespace

std::optional<Touch> find_touch(double gap, double velocity, double acceleration, double step) {
  const double rate = velocity + acceleration * step / 2;
  const double square = rate * rate - 2 * acceleration * gap;
  if (!(square >= 0)) return std::nullopt;
  const double closing = std::sqrt(square) - rate;
  if (!(2 * gap <= step * closing)) return std::nullopt;
  return Touch{2 * gap / closing, std::sqrt(square)};
}

// On its parabola a resting body touches with half of what forces change in a step, and with what quickstep leaves. It is no impact
// at any restitution. A body that comes back within a step would bounce for ever.
bool is_impact(double speed, double restitution, double load, double step) {
  return std::min(1.0, 2 * restitution) * speed > load * step;
}

void let_close_or_bounce(dContact& contact, double step) {
  dSurfaceParameters& surface = contact.surface;
  const double depth = contact.geom.depth;
  const double of_surface = (surface.mode & dContactMotionN) != 0 ? double{surface.motionN} : 0;
  std::optional<double> bounce;
  if ((surface.mode & dContactBounce) != 0) {
    const Separation now = Separation::at(contact, of_surface);
    bounce = find_bounce(contact, now, step);
    if (bounce && *bounce > 0) {
      // dWorldSetContactMaxCorrectingVel limits motionN, but not ODE's restitution.
      surface.bounce = to_real(*bounce / -now.velocity);
      contact.geom.depth = 0;
      return;
    }
    // Overlapping bodies that part are not pushed apart: this would give them energy.
    if (now.velocity > now.load * step) contact.geom.depth = to_real(std::min(0.0, depth));
  }
  if (!(depth < 0)) {
    surface.mode &= ~dContactBounce;
    return;
  }
  const double leaving = std::max(depth / step, bounce.value_or(depth / step));
  const double motion = of_surface + leaving;
  const auto largest = double{std::numeric_limits<dReal>::max()};
  if (!(std::abs(motion) <= largest)) {
    throw std::invalid_argument("step = " + to_text(step) + " s closes the gap of " + to_text(-double{contact.geom.depth}) +
                                " m with " + to_text(-motion) + " m/s, but motionN must be within " + to_text(largest) + " m/s");
  }
  surface.mode = (surface.mode | dContactMotionN) & ~dContactBounce;
  surface.motionN = to_real(motion);
  contact.geom.depth = 0;
}

}  // namespace supernormal::ode
