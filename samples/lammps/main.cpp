// LAMMPS with pair_style supernormal. Takes the arguments of lmp.
#include <mpi.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "styles/fix_nve_supernormal.hpp"
#include "styles/fix_wall_supernormal.hpp"
#include "styles/pair_supernormal.hpp"

namespace {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::Pair;

// LAMMPS takes raw pointers and owns the objects.
template <typename Style>
Pair* create_pair(LAMMPS* lammps) {
  return new Style(lammps);
}

template <typename Style>
Fix* create_fix(LAMMPS* lammps, int count, char** words) {
  return new Style(lammps, count, words);
}

/// Call it before LAMMPS reads its input.
void register_styles(LAMMPS& lammps) {
  (*lammps.force->pair_map)["supernormal"] = &create_pair<granular::PairSupernormal>;
  (*lammps.modify->fix_map)["nve/supernormal"] = &create_fix<granular::FixNveSupernormal>;
  (*lammps.modify->fix_map)["wall/supernormal"] = &create_fix<granular::FixWallSupernormal>;
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int failed = 0;
  try {
    const auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc, argv, MPI_COMM_WORLD);
    register_styles(*lammps);
    lammps->input->file();
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "supernormal_lammps: %s\n", failure.what());
    failed = 1;
  }
  if (failed != 0) MPI_Abort(MPI_COMM_WORLD, failed);
  MPI_Finalize();
  return 0;
}
