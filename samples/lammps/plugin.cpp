// The styles as a plugin of LAMMPS. LAMMPS calls lammpsplugin_init() when it loads the file.
#include "lammps.h"
#include "lammpsplugin.h"
#include "styles/fix_nve_supernormal.hpp"
#include "styles/fix_rigid_supernormal.hpp"
#include "styles/fix_wall_supernormal.hpp"
#include "styles/pair_supernormal.hpp"
#include "version.h"

namespace {

using LAMMPS_NS::Fix;
using LAMMPS_NS::FixRigid;
using LAMMPS_NS::FixRigidNVE;
using LAMMPS_NS::FixRigidNVESmall;
using LAMMPS_NS::FixRigidSmall;
using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::Pair;

constexpr const char* kClusters = "rigid clusters of superellipsoids";

// LAMMPS takes raw pointers and owns the objects.
template <typename Style>
Pair* create_pair(LAMMPS* lammps) {
  return new Style(lammps);
}

template <typename Style>
Fix* create_fix(LAMMPS* lammps, int count, char** words) {
  return new Style(lammps, count, words);
}

using PairCreator = Pair*(LAMMPS*);
using FixCreator = Fix*(LAMMPS*, int, char**);

lammpsplugin_t style_of(const char* kind, const char* name, const char* info, void* handle) {
  lammpsplugin_t style{};
  style.version = LAMMPS_VERSION;
  style.style = kind;
  style.name = name;
  style.info = info;
  style.author = "Supernormal";
  style.handle = handle;
  return style;
}

lammpsplugin_t pair_style(PairCreator* creator, const char* name, const char* info, void* handle) {
  lammpsplugin_t style = style_of("pair", name, info, handle);
  style.creator.v1 = reinterpret_cast<lammpsplugin_factory1*>(creator);
  return style;
}

lammpsplugin_t fix_style(FixCreator* creator, const char* name, const char* info, void* handle) {
  lammpsplugin_t style = style_of("fix", name, info, handle);
  style.creator.v2 = reinterpret_cast<lammpsplugin_factory2*>(creator);
  return style;
}

}  // namespace

/// Registers the styles by `register_style` (a lammpsplugin_regfunc) with an instance of LAMMPS.
extern "C" [[gnu::visibility("default")]] void lammpsplugin_init(void* lammps, void* handle, void* register_style) {
  using namespace granular;
  for (lammpsplugin_t style :
       {pair_style(&create_pair<PairSupernormal>, "supernormal", "contacts of superellipsoids", handle),
        fix_style(&create_fix<FixContactHistory>, "SUPERNORMAL_HISTORY", "histories of contacts", handle),
        fix_style(&create_fix<FixNveSupernormal>, "nve/supernormal", "motion of superellipsoids", handle),
        fix_style(&create_fix<FixWallSupernormal>, "wall/supernormal", "walls of superellipsoids", handle),
        fix_style(&create_fix<FixRigidSupernormal<FixRigid>>, "rigid/supernormal", kClusters, handle),
        fix_style(&create_fix<FixRigidSupernormal<FixRigidNVE>>, "rigid/nve/supernormal", kClusters, handle),
        fix_style(&create_fix<FixRigidSupernormal<FixRigidSmall>>, "rigid/small/supernormal", kClusters, handle),
        fix_style(&create_fix<FixRigidSupernormal<FixRigidNVESmall>>, "rigid/nve/small/supernormal", kClusters, handle)}) {
    reinterpret_cast<lammpsplugin_regfunc>(register_style)(&style, lammps);
  }
}
