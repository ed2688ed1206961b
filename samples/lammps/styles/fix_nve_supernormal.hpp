// fix nve/supernormal: integrates the motion of the particles.
#pragma once

#include <array>

#include "fix.h"
#include "styles/pair_supernormal.hpp"
#include "styles/stored_forces.hpp"

namespace granular {

/// Velocity Verlet with the inertia of superellipsoids and a symplectic rotation. (The fix nve/asphere of LAMMPS uses the inertia
/// of ellipsoids.) Its scalar is the kinetic energy of rotation, J. Its vector contains the linear momentum and the angular
/// momentum about the origin, with unwrapped positions.
/// A restarted run gives the same digits.
class FixNveSupernormal : public LAMMPS_NS::Fix {
 public:
  FixNveSupernormal(LAMMPS_NS::LAMMPS* lammps, int count, char** words);
  ~FixNveSupernormal() override;

  int setmask() override;
  void init() override;
  void initial_integrate(int vflag) override;
  void final_integrate() override;
  double compute_scalar() override;
  double compute_vector(int index) override;

  void grow_arrays(int count) override { forces_.grow(count); }
  void copy_arrays(int from, int to, int /*deleted*/) override { forces_.copy(from, to); }
  void set_arrays(int i) override { forces_.forget(i); }
  int pack_exchange(int i, double* buffer) override { return forces_.pack(i, buffer); }
  int unpack_exchange(int i, double* buffer) override { return forces_.unpack(i, buffer); }
  int pack_restart(int i, double* buffer) override { return forces_.pack_restart(i, buffer); }
  void unpack_restart(int i, int set) override { forces_.unpack_restart(*atom, i, set); }
  int size_restart(int /*i*/) override { return StoredForces::kRestartSize; }
  int maxsize_restart() override { return StoredForces::kRestartSize; }

 private:
  void kick(int i);
  void find_momentum();

  BodyTable* bodies_ = nullptr;
  StoredForces forces_;
  std::array<double, 6> momentum_{};
  LAMMPS_NS::bigint momentum_step_ = -1;
};

}  // namespace granular
