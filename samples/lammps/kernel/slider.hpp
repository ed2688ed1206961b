// A spring and a damper in line with a slider: friction and rolling resistance.
#pragma once

#include <Eigen/Core>

namespace granular {

using Vector3 = Eigen::Vector3d;

/// The answer of a slider. Units are those of a force and a displacement, or of a torque and an angle.
struct SliderForce {
  Vector3 force = Vector3::Zero();   ///< against the motion
  Vector3 spring = Vector3::Zero();  ///< the deflection that is left
  bool slips = false;                ///< the limit was reached
};

/// The force of a spring deflected by `spring` and a damper at a `rate`, no larger than `limit`. What the limit cuts off is taken
/// out of the spring, so that it pulls back as soon as the motion turns round.
SliderForce slide(const Vector3& spring, const Vector3& rate, double stiffness, double damping, double limit);

}  // namespace granular
