// The slip of a contact after a step without friction. Friction opposes it.
#pragma once

#include <algorithm>
#include <cmath>

#include "effects/motion.hpp"
#include "effects/pair_material.hpp"

namespace supernormal::effects {

class Slip {
 public:
  explicit Slip(const Patch& patch)
      : body1_(patch.body1), body2_(patch.body2), gain_(patch.step * (acceleration_of(body1_) - acceleration_of(body2_))) {}

  /// m/s; the tangential velocity of body 1 relative to body 2, world frame.
  Vector3 at(const dContact& contact) const {
    const Vector3 point = ode::to_vector(contact.geom.pos);
    const Vector3 n = ode::to_vector(contact.geom.normal);
    const Vector3 velocity = velocity_at(body1_, point) - velocity_at(body2_, point) + gain_;
    return velocity - n.dot(velocity) * n;
  }

 private:
  dBodyID body1_;
  dBodyID body2_;
  Vector3 gain_;
};

/// The half-sides of a rectangle that is inscribed in the unit circle. Its vertex is as near as possible to the direction (x, y),
/// but no half-side is shorter than 0.1. So no direction is left without friction.
struct InscribedRectangle {
  double first, second;

  static InscribedRectangle towards(double x, double y) {
    constexpr double kLeast = 0.1;
    const double length = std::hypot(x, y);
    if (!(length > 1e-150)) return {std::sqrt(0.5), std::sqrt(0.5)};
    const double most = std::sqrt(1 - kLeast * kLeast);
    const double first = std::clamp(std::abs(x) / length, kLeast, most);
    return {first, std::sqrt(1 - first * first)};
  }
};

}  // namespace supernormal::effects
