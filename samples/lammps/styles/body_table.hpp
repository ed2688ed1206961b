// The particles of a rank, owned and ghosts, as the kernel's bodies.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/body.hpp"
#include "kernel/shape_cache.hpp"
#include "lammps.h"

namespace LAMMPS_NS {
class AtomVecEllipsoid;
}

namespace granular {

/// Reads LAMMPS' ellipsoid particles. Exponents belong to types, half-axes to particles.
class BodyTable {
 public:
  /// For the atom types 1 to `types`; exponents are 2 until they are set.
  BodyTable(LAMMPS_NS::LAMMPS* lammps, int types);

  struct Exponents {
    double delta = 2, epsilon = 2;
  };
  Exponents& exponents(int type) { return exponents_[static_cast<std::size_t>(type)]; }

  /// The largest bounding radius (m) of the particles of a type, on all ranks; 0 where there is none. To be asked when a run
  /// starts: a particle that is larger is refused later on.
  const std::vector<double>& find_largest_radii();

  /// Finds the shapes of all particles: whenever their order or number changes.
  void assign_shapes();

  /// Reads poses and velocities of all particles.
  void read_motion();

  const ParticleShape& shape(int i) const { return *shapes_[static_cast<std::size_t>(i)]; }
  const Body& body(int i) const { return bodies_[static_cast<std::size_t>(i)]; }
  double bytes() const;  ///< of memory

  /// The quaternion (w, x, y, z; body to world) of particle i, in LAMMPS' memory.
  double* quaternion(int i) const;

 private:
  const ParticleShape& find_shape(int i);

  LAMMPS_NS::LAMMPS* lammps_;
  LAMMPS_NS::AtomVecEllipsoid* ellipsoids_;
  std::vector<Exponents> exponents_;  // by type
  std::vector<double> largest_radii_;
  ShapeCache cache_;
  std::vector<const ParticleShape*> shapes_;  // by particle
  std::vector<Body> bodies_;
};

}  // namespace granular
