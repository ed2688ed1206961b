// LAMMPS with the plugin of this folder. Takes the arguments of lmp. Debian's LAMMPS has no command `plugin`.
#include <dlfcn.h>
#include <mpi.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "force.h"
#include "input.h"
#include "lammps.h"
#include "lammpsplugin.h"
#include "modify.h"

namespace {

using LAMMPS_NS::Force;
using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::Modify;

/// Adds a style of a plugin to an instance of LAMMPS.
void add_style(lammpsplugin_t* style, void* instance) {
  const LAMMPS& lammps = *static_cast<LAMMPS*>(instance);
  if (style->style == std::string_view("pair")) {
    (*lammps.force->pair_map)[style->name] = reinterpret_cast<Force::PairCreator>(style->creator.v1);
  } else {
    (*lammps.modify->fix_map)[style->name] = reinterpret_cast<Modify::FixCreator>(style->creator.v2);
  }
}

/// Call it before LAMMPS reads its input. The plugin is in the folder of the program, which is its RUNPATH.
void load_plugin(LAMMPS& lammps) {
  void* const plugin = dlopen("supernormalplugin.so", RTLD_NOW);
  if (plugin == nullptr) throw std::runtime_error(dlerror());
  const auto init = reinterpret_cast<lammpsplugin_initfunc>(dlsym(plugin, "lammpsplugin_init"));
  if (init == nullptr) throw std::runtime_error(dlerror());
  init(&lammps, plugin, reinterpret_cast<void*>(&add_style));
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int failed = 0;
  try {
    const auto lammps = std::make_unique<LAMMPS>(argc, argv, MPI_COMM_WORLD);
    load_plugin(*lammps);
    lammps->input->file();
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "supernormal_lammps: %s\n", failure.what());
    failed = 1;
  }
  if (failed != 0) MPI_Abort(MPI_COMM_WORLD, failed);
  MPI_Finalize();
  return 0;
}
