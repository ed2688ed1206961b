// A run as particle programs read it.
#pragma once

#include <filesystem>

#include "base/write_file.hpp"
#include "picture.hpp"

namespace falling_particles {

/// grains.lammpstrj: a LAMMPS text dump for OVITO, and whatever else reads these. An atom per grain, its type that of its kind in
/// the order of the scene file, from 1 on. As LAMMPS has written them since July 2020, shapex, shapey, shapez are diameters (m),
/// which OVITO halves; quati, quatj, quatk, quatw are the attitude. roundness_phi = 2/delta and roundness_theta = 2/epsilon are
/// what OVITO calls Superquadric Roundness. The rounding of a grain's edges and the taper have no column, and a capsule is the
/// ellipsoid of its size. A compound has an atom per part; in scenes with compounds, mol is the number of the grain.
class LammpsDump final : public Picture {
 public:
  LammpsDump(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  const Contents& contents_;
  OutputFile file_;
  int frames_ = 0;
};

}  // namespace falling_particles
