// The particles of a rank, owned and ghosts, as bodies of the kernel, and what moves rigid clusters of them.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <vector>

#include "kernel/body.hpp"
#include "kernel/particle_shape.hpp"
#include "lammps.h"

namespace LAMMPS_NS {
class AtomVecEllipsoid;
}

namespace granular {

/// Reads the ellipsoid particles of LAMMPS. Half-axes belong to particles; exponents belong to types, or to particles as d_delta
/// and d_epsilon of fix property/atom.
class BodyTable {
 public:
  /// For the atom types 1 to `types`. Their exponents are initially 2.
  BodyTable(LAMMPS_NS::LAMMPS* lammps, int types);

  struct Exponents {
    double delta = 2, epsilon = 2;
  };
  Exponents& exponents(int type) { return exponents_[static_cast<std::size_t>(type)]; }

  /// Takes the exponents from the particles. Call it when a run starts. Raises a LAMMPS error if they have none.
  void use_particle_exponents();
  /// The exponents of particle i in memory of LAMMPS. Only after use_particle_exponents(). Ghosts have them if the caller copies
  /// them.
  double& delta(int i) const;
  double& epsilon(int i) const;

  /// The largest bounding radius (m) of each type, on all ranks; 0 if it has no particles. Call it when a run starts: larger
  /// particles are refused during the run.
  const std::vector<double>& find_largest_radii();

  /// Finds the shapes of all particles. Call it whenever their order or number changes.
  void assign_shapes();

  /// The clusters of particles, by their index; the caller copies the clusters of ghosts. Empty if there are none.
  std::vector<Cluster>& clusters() { return clusters_; }
  bool are_in_one_cluster(int i, int j) const {
    return !clusters_.empty() && clusters_[static_cast<std::size_t>(i)].is_same(clusters_[static_cast<std::size_t>(j)]);
  }

  /// Reads poses and velocities of all particles.
  void read_motion();

  const ParticleShape& shape(int i) const { return *shapes_[static_cast<std::size_t>(i)]; }
  const Body& body(int i) const { return bodies_[static_cast<std::size_t>(i)]; }
  /// An upper bound of the way (m) of any point of the particle by rotation, since assign_shapes(). It never decreases.
  double rotated(int i) const { return turns_[static_cast<std::size_t>(i)].way; }

  /// The quaternion (w, x, y, z; body to world) of particle i, in memory of LAMMPS.
  double* quaternion(int i) const;
  /// The three half-axes of particle i, in memory of LAMMPS.
  double* half_axes(int i) const;
  /// The shape of an owned particle at any time. shape() is faster.
  const ParticleShape& find_shape(int i);

 private:
  LAMMPS_NS::LAMMPS* lammps_;
  LAMMPS_NS::AtomVecEllipsoid* ellipsoids_;
  std::vector<Exponents> exponents_;  // per type
  int delta_ = -1, epsilon_ = -1;     // indices of the properties of particles; -1 without
  std::vector<double> largest_radii_;
  std::map<std::array<double, 5>, ParticleShape> cache_;  // by half-axes (m) and exponents; addresses are valid until clear()
  std::vector<const ParticleShape*> shapes_;              // per particle
  std::vector<Body> bodies_;
  std::vector<Cluster> clusters_;
  struct Turn {
    Eigen::Vector4d quaternion = Eigen::Vector4d::Zero();  // when last read
    double way = 0;                                        // m
  };
  std::vector<Turn> turns_;
};

/// A fix whose clusters the pair style knows.
class RigidClusters {
 public:
  RigidClusters() = default;
  RigidClusters(const RigidClusters&) = delete;
  RigidClusters& operator=(const RigidClusters&) = delete;

  /// The cluster of an owned particle. The answer is valid until LAMMPS builds its neighbour lists again.
  virtual Cluster cluster(int i) const = 0;

 protected:
  // Not virtual: LAMMPS deletes its fixes as such, and their destructors may throw in some versions.
  ~RigidClusters() = default;
};

}  // namespace granular
