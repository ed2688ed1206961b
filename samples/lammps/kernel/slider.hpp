// A spring-damper in series with a slider: friction and rolling resistance.
#pragma once

#include <Eigen/Core>

namespace granular {

using Vector3 = Eigen::Vector3d;

/// The state of a slider. Units: force and displacement, or torque and angle.
struct SliderForce {
  Vector3 force = Vector3::Zero();   ///< against the motion
  Vector3 spring = Vector3::Zero();  ///< the remaining deflection
  bool slips = false;                ///< whether the limit was reached
};

/// The force of a spring with the deflection `spring` and a damper with the velocity `rate`, at most `limit`. Beyond the limit the
/// spring is shortened, so it pulls back as soon as the motion reverses.
SliderForce slide(const Vector3& spring, const Vector3& rate, double stiffness, double damping, double limit);

}  // namespace granular
