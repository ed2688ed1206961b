// fix nve/supernormal: integrates the motion of the particles.
#pragma once

#include <array>

#include "fix.h"
#include "styles/pair_supernormal.hpp"

namespace granular {

/// Velocity Verlet with the inertia of superellipsoids and a symplectic rotation. (The fix nve/asphere of LAMMPS uses the inertia
/// of ellipsoids.) Its scalar is the kinetic energy of rotation, J. Its vector contains the linear momentum and the angular
/// momentum about the origin, with unwrapped positions.
///
/// The restart file stores the forces of the last step for every particle. LAMMPS would recompute them from velocities half a step
/// later, and dampers depend on velocities. So a restarted run gives the same digits.
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

  void grow_arrays(int count) override;
  void copy_arrays(int from, int to, int deleted) override;
  int pack_exchange(int i, double* buffer) override;
  int unpack_exchange(int i, double* buffer) override;
  int pack_restart(int i, double* buffer) override;
  void unpack_restart(int i, int set) override;
  int size_restart(int i) override;
  int maxsize_restart() override;
  double memory_usage() override;

 private:
  static constexpr int kForces = 6;

  void kick(int i);
  void find_momentum();

  BodyTable* bodies_ = nullptr;
  double** forces_ = nullptr;  // of the last step: force and torque of each particle
  bool restored_ = false;      // whether forces_ come from a restart file
  std::array<double, 6> momentum_{};
  LAMMPS_NS::bigint momentum_step_ = -1;
};

}  // namespace granular
