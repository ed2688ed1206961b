// What contacts and joints have in common: two bodies, and rows along or about which an impulse acts on both.
#pragma once

#include <limits>

#include "stepper/body.hpp"

namespace supernormal::stepper {

inline constexpr double kAny = std::numeric_limits<double>::infinity();
inline constexpr double kLargest = std::numeric_limits<double>::max();

/// One direction in which a contact or a joint pushes, or an axis about which it turns.
struct Row {
  Vector3 direction;             ///< unit; of the force or torque on body 1; body 2 has the opposite
  Vector3 response1, response2;  ///< 1/(kg m) or 1/(kg m^2); of the angular velocities to a unit impulse; body 2: opposite sign
  double mobility = 0;           ///< 1/kg or 1/(kg m^2); the change of the relative velocity by a unit impulse
  double impulse = 0;            ///< N s or N m s; in the present sub-step, so far
  double later = 0;              ///< N s or N m s; the part of the last impulse that follows after the positions
  double total = 0;              ///< N s; so far in the step; along the normal without impacts

  /// For the levers of a force along `towards` or of a torque about it: an impulse there turns the bodies about them. The mobility
  /// is that of the rotations alone.
  void set(const Vector3& towards, const Body& one, const Vector3& lever1, const Body& two, const Vector3& lever2) {
    direction = towards;
    response1 = one.world_inverse_inertia * lever1;
    response2 = two.world_inverse_inertia * lever2;
    mobility = lever1.dot(response1) + lever2.dot(response2);
  }
};

struct Link {
  int body1 = 0, body2 = 0;  ///< in System::bodies
  Vector3 arm1, arm2;        ///< m; from the centres of mass to the place
  double part_before = 1;    ///< the part of its last impulse that acts before the positions
};

}  // namespace supernormal::stepper
