// A rigid cluster of particles.
#pragma once

#include "kernel/body.hpp"

namespace granular {

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
