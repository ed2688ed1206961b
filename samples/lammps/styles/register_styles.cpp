#include "styles/register_styles.hpp"

#include "force.h"
#include "modify.h"
#include "styles/fix_nve_supernormal.hpp"
#include "styles/fix_wall_supernormal.hpp"
#include "styles/pair_supernormal.hpp"

namespace granular {
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

}  // namespace

void register_styles(LAMMPS& lammps) {
  (*lammps.force->pair_map)["supernormal"] = &create_pair<PairSupernormal>;
  (*lammps.modify->fix_map)["nve/supernormal"] = &create_fix<FixNveSupernormal>;
  (*lammps.modify->fix_map)["wall/supernormal"] = &create_fix<FixWallSupernormal>;
}

}  // namespace granular
