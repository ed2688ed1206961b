// LAMMPS with LAMMPS' own loader of plugins, for check_plugin: the plugins in the folders of LAMMPS_PLUGIN_PATH are loaded first.
#include <mpi.h>

#include "input.h"
#include "lammps.h"
#include "plugin.h"

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  {
    LAMMPS_NS::LAMMPS lammps(argc, argv, MPI_COMM_WORLD);
    LAMMPS_NS::plugin_auto_load(&lammps);
    lammps.input->file();
    LAMMPS_NS::plugin_clear(&lammps);
  }
  MPI_Finalize();
  return 0;
}
