// LAMMPS with pair_style supernormal. Takes the arguments of lmp.
#include <mpi.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "input.h"
#include "lammps.h"
#include "styles/register_styles.hpp"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int failed = 0;
  try {
    const auto lammps = std::make_unique<LAMMPS_NS::LAMMPS>(argc, argv, MPI_COMM_WORLD);
    granular::register_styles(*lammps);
    lammps->input->file();
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "supernormal_lammps: %s\n", failure.what());
    failed = 1;
  }
  if (failed != 0) MPI_Abort(MPI_COMM_WORLD, failed);
  MPI_Finalize();
  return 0;
}
