// A body of ODE within a step, and the rows along or about which impulses act on two.
#pragma once

#include <ode/ode.h>

#include <Eigen/Geometry>
#include <limits>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::stepper {

inline constexpr double kAny = std::numeric_limits<double>::infinity();
inline constexpr double kLargest = std::numeric_limits<double>::max();

struct Body {
  /// Reads state, mass and forces from ODE. In the rest of a step that ended early, the forces of its first part act on, unless the
  /// program has given others. Throws std::invalid_argument if a number is not finite.
  void read(const Vector3& gravity, bool is_rest);

  /// Gives ODE the forces and torques of the step, for what quickstep moves.
  void restore_forces() const;

  /// Adds what forces and torques change in `time` (s).
  void apply_forces(double time);

  /// The part of the forces of a sub-step that acts before the positions: half where the sub-step is centred in time. In stacks
  /// that rest all of it, or light bodies under heavy ones hop (README).
  double part_before() const { return is_centred ? 0.5 : 1; }

  /// Moves the body on by `time` (s). The angular momentum stays as it is in the world, so no gyroscopic torque is needed.
  void advance(double time);

  /// Turns the inertia with the body, if it moves.
  void turn_inertia() {
    if (is_dynamic()) world_inverse_inertia = rotation * inverse_inertia_ * rotation.transpose();
  }

  /// Gives place, orientation and velocities to ODE and removes the forces, as a step of ODE does. `fraction` of ODE's damping of a
  /// step is applied.
  void write(double fraction);

  /// Makes it immovable for this step.
  void hold_still();

  /// Sets is_restless after `time` (s) of motion. A body must not sleep unless it has been slower than ODE's thresholds for
  /// auto-disabling for as long as they say.
  void watch(double time);

  /// Whether the body will be far from the path that it had when the step began, `time` (s) ago, when it ends after `left` (s), so
  /// that its contacts are no longer those that it meets.
  bool has_left_path(double time, double left) const;

  bool is_dynamic() const { return inverse_mass > 0; }
  bool is_of_quickstep() const { return is_held && is_free; }

  /// m/s^2, of forces; 0 for what no force moves.
  Vector3 acceleration() const { return is_dynamic() ? acceleration_ : Vector3::Zero(); }

  /// The centre of mass, m.
  Vector3 centre() const { return start + moved; }

  // What sweeps read and write.
  Vector3 velocity = Vector3::Zero();          ///< m/s
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s
  double inverse_mass = 0;                     ///< 1/kg; 0 for what no force moves
  int struck = 0;                              ///< the passes of a sweep that struck it, one after the other
  Vector3 moved = Vector3::Zero();             ///< m, since the step began
  Vector3 rotated = Vector3::Zero();           ///< rad, since the step began

  dBodyID id = nullptr;                             ///< null: what does not move
  Vector3 start = Vector3::Zero();                  ///< m; the centre of mass when the step began
  Eigen::Quaterniond orientation{1, 0, 0, 0};       ///< now
  Matrix3 rotation = Matrix3::Identity();           ///< now
  Matrix3 world_inverse_inertia = Matrix3::Zero();  ///< 1/(kg m^2), when the step began or it last bounced; now, if is_followed
  double size = std::numeric_limits<double>::infinity();  ///< m; the smallest radius of gyration; infinite for what no force moves
  /// m; the least distance of its mass from a plane through the centre, root mean square times the root of 2: `size` for a cube,
  /// and in proportion to the thickness of a plate. Infinite for what no force moves.
  double thickness = std::numeric_limits<double>::infinity();
  bool is_touched = false;   ///< whether it has a contact
  bool is_borne = false;     ///< whether it touches what it has a contact with
  bool is_followed = false;  ///< whether a contact or a joint follows its motion within the step
  bool is_free = false;      ///< whether it is not kinematic
  bool stirs = false;        ///< whether it wakes what it touches: kinematic bodies at rest do not
  bool is_awake = false;     ///< whether it moves; spreads by contacts
  bool is_held = false;      ///< whether a joint holds it for which quickstep must move it; spreads by contacts and joints
  bool is_centred = false;   ///< whether its sub-steps are centred in time; spreads by contacts
  bool is_restless = true;   ///< whether it must not sleep; spreads by contacts

 private:
  void read_mass();
  void limit_angular_speed();
  Vector3 spin_of(const Matrix3& at, const Vector3& momentum) const {
    return at * (inverse_inertia_ * (at.transpose() * momentum));
  }

  Matrix3 inertia_ = Matrix3::Zero();          // kg m^2, body's frame
  Matrix3 inverse_inertia_ = Matrix3::Zero();  // 1/(kg m^2), body's frame
  Vector3 acceleration_ = Vector3::Zero();     // m/s^2, of forces
  Vector3 force_ = Vector3::Zero();            // N, as the program gave it
  Vector3 torque_ = Vector3::Zero();           // N m
  Vector3 first_velocity_ = Vector3::Zero();   // m/s, when the step began
  Vector3 first_angular_velocity_ = Vector3::Zero();
  double max_angular_speed_ = 0;  // rad/s
  bool keeps_momentum_ = false;

  struct Rest {
    double idle_time = 0;  // s, for which the body has been slow
    int idle_steps = 0;
    Vector3 travelled = Vector3::Zero(), turned = Vector3::Zero();  // m, rad; since the last mean of its velocities
    double time = 0;                                                // s
    int samples = 0;
  } rest_;
};

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

/// What contacts and joints have in common.
struct Link {
  int body1 = 0, body2 = 0;  ///< in System::bodies
  Vector3 arm1, arm2;        ///< m; from the centres of mass to the place
  double part_before = 1;    ///< the part of its last impulse that acts before the positions
};

}  // namespace supernormal::stepper
