// A rigid body in contacts.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "kernel/face.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace granular {

/// The state of a body in the world frame. A particle of a rigid cluster has the mass and the inertia of the cluster.
struct Body {
  const supernormal::Shape* shape = nullptr;
  supernormal::Pose pose;
  Vector3 velocity = Vector3::Zero();          ///< m/s; of the origin of the body's frame
  Vector3 angular_velocity = Vector3::Zero();  ///< rad/s
  double inverse_mass = 0;                     ///< 1/kg; 0 for a body that forces do not move
  Matrix3 inverse_inertia = Matrix3::Zero();   ///< 1/(kg m^2); about the centre of mass
  Vector3 from_centre = Vector3::Zero();       ///< m; the origin of the body's frame, from the centre of mass
  double width = 0;                            ///< m; the mean half-extent
  std::span<const Face> faces{};               ///< none for a round body
  std::span<const Side> sides{};               ///< none for a round body
  double bulge = 0;                            ///< m; no face and no side sticks out of the body by more than this

  bool is_flat() const { return !(faces.empty() && sides.empty()); }
  /// The velocity of the body's point at `arm` from its centre, m/s.
  Vector3 velocity_at(const Vector3& arm) const { return velocity + angular_velocity.cross(arm); }
};

}  // namespace granular
