// What moves rigid clusters of particles.
#pragma once

#include "kernel/cluster.hpp"

namespace granular {

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
