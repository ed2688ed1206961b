// A rigid body in contacts, and the rigid cluster that a particle may belong to.
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

/// The cluster that a particle belongs to, in the frame of the particle. It is constant, as the cluster is rigid.
struct Cluster {
  double id = 0;                              ///< equal for all particles of a cluster; 0 for none
  double inverse_mass = 0;                    ///< 1/kg
  Vector3 from_centre = Vector3::Zero();      ///< m; the centre of the particle, from the centre of mass of the cluster
  Matrix3 inverse_inertia = Matrix3::Zero();  ///< 1/(kg m^2); about the centre of mass of the cluster

  static constexpr int kSize = 14;  ///< how many numbers store one cluster

  /// Whether two particles never touch.
  bool is_same(const Cluster& other) const { return id != 0 && id == other.id; }
  bool is_none() const { return id == 0; }

  /// Gives the mobility of the cluster to a particle with a pose.
  void apply(Body& body) const {
    const Matrix3& rotation = body.pose.rotation;
    body.inverse_mass = inverse_mass;
    body.inverse_inertia = rotation * inverse_inertia * rotation.transpose();
    body.from_centre = rotation * from_centre;
  }

  /// Reads and writes a cluster as an array of numbers.
  static Cluster load(const double* values) { return {values[0], values[1], Vector3::Map(values + 2), Matrix3::Map(values + 5)}; }
  void store(double* values) const {
    values[0] = id;
    values[1] = inverse_mass;
    Vector3::Map(values + 2) = from_centre;
    Matrix3::Map(values + 5) = inverse_inertia;
  }
};

}  // namespace granular
