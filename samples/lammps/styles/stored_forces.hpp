// The forces of the last step on each particle, in restart files.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "atom.h"

namespace granular {

/// What a fix that moves particles stores for each of them, so that a restarted run goes on with the forces of the step before.
/// LAMMPS would recompute them from velocities half a step later, and dampers depend on velocities.
class StoredForces {
 public:
  static constexpr int kSize = 6;                 ///< numbers that store a particle: force and torque
  static constexpr int kRestartSize = kSize + 1;  ///< the same in a restart file

  void grow(int count) { forces_.resize(static_cast<std::size_t>(count), none()); }
  void forget(int i) { at(i) = none(); }  ///< of a new particle
  void copy(int from, int to) { at(to) = at(from); }
  int pack(int i, double* buffer) const;
  int unpack(int i, const double* buffer);
  int pack_restart(int i, double* buffer) const;
  /// Reads what LAMMPS keeps of the restart file for the fix number `set`.
  void unpack_restart(const LAMMPS_NS::Atom& atom, int i, int set);

  /// Stores the present forces on a particle.
  void store(const LAMMPS_NS::Atom& atom, int i);
  /// Whether the forces come from a restart file. Then put_back() sets those that are known, and the caller resets this.
  bool is_restored = false;
  void put_back(LAMMPS_NS::Atom& atom, int i) const;

  double bytes() const { return static_cast<double>(forces_.capacity() * sizeof(Forces)); }  ///< memory in use

 private:
  using Forces = std::array<double, kSize>;
  static constexpr Forces none() { return {std::numeric_limits<double>::quiet_NaN()}; }
  Forces& at(int i) { return forces_[static_cast<std::size_t>(i)]; }
  const Forces& at(int i) const { return forces_[static_cast<std::size_t>(i)]; }

  std::vector<Forces> forces_;
};

}  // namespace granular
