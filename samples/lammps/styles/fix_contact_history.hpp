// fix SUPERNORMAL_HISTORY: the histories of pairs, which the pair style creates.
#pragma once

#include <cstdio>

#include "comm.h"
#include "fix_neigh_history.h"
#include "update.h"

namespace granular {

/// LAMMPS' history of neighbours, which write_restart between two runs does not spoil. LAMMPS stores the histories with the
/// particles at the end of a run, and again for the file. By then its ghosts are new, but the list of neighbours is not, so pairs
/// across a periodic side would get other particles' springs.
class FixContactHistory : public LAMMPS_NS::FixNeighHistory {
 public:
  using FixNeighHistory::FixNeighHistory;

  void post_run() override {
    FixNeighHistory::post_run();
    stored_ = update->ntimestep;
  }
  void post_neighbor() override {
    FixNeighHistory::post_neighbor();
    stored_ = kNever;
  }
  void write_restart(FILE* file) override {
    if (update->ntimestep != stored_) return FixNeighHistory::write_restart(file);
    const int size = 0;  // of what is stored besides the particles
    if (comm->me == 0) fwrite(&size, sizeof size, 1, file);
  }

 private:
  static constexpr LAMMPS_NS::bigint kNever = -1;
  LAMMPS_NS::bigint stored_ = kNever;  // the step whose histories a run has stored at its end, until the next list of neighbours
};

}  // namespace granular
