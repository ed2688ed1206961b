// The forces of the last step on each particle, in restart files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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
  int pack(int i, double* buffer) const {
    std::ranges::copy(at(i), buffer);
    return kSize;
  }
  int unpack(int i, const double* buffer) {
    std::copy_n(buffer, kSize, at(i).begin());
    return kSize;
  }
  /// In a restart file, the first number of a fix is the count of its numbers.
  int pack_restart(int i, double* buffer) const {
    buffer[0] = kRestartSize;
    return 1 + pack(i, buffer + 1);
  }
  /// Reads what LAMMPS keeps of the restart file for the fix number `set`.
  void unpack_restart(const LAMMPS_NS::Atom& atom, int i, int set) {
    const double* numbers = atom.extra[i];
    for (int k = 0; k < set; ++k) numbers += static_cast<int>(*numbers);
    unpack(i, numbers + 1);
    is_restored = true;
  }

  /// Stores the present forces on a particle.
  void store(const LAMMPS_NS::Atom& atom, int i) {
    std::copy_n(atom.f[i], 3, at(i).begin());
    std::copy_n(atom.torque[i], 3, at(i).begin() + 3);
  }
  /// Whether the forces come from a restart file. Then put_back() sets those that are known, and the caller resets this.
  bool is_restored = false;
  void put_back(LAMMPS_NS::Atom& atom, int i) const {
    if (std::isnan(at(i)[0])) return;
    std::copy_n(at(i).begin(), 3, atom.f[i]);
    std::copy_n(at(i).begin() + 3, 3, atom.torque[i]);
  }

 private:
  using Forces = std::array<double, kSize>;
  static constexpr Forces none() { return {std::numeric_limits<double>::quiet_NaN()}; }
  Forces& at(int i) { return forces_[static_cast<std::size_t>(i)]; }
  const Forces& at(int i) const { return forces_[static_cast<std::size_t>(i)]; }

  std::vector<Forces> forces_;
};

}  // namespace granular
