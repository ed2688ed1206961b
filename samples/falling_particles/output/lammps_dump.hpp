// A run as a LAMMPS dump.
#pragma once

#include <filesystem>

#include "base/write_file.hpp"
#include "picture.hpp"

namespace falling_particles {

/// grains.lammpstrj: a LAMMPS text dump for OVITO and other programs. Each grain is an atom. The type is the index of its kind in
/// the scene file, from 1. As in LAMMPS since July 2020, shapex, shapey, shapez are diameters (m), which OVITO halves; quati,
/// quatj, quatk, quatw are the orientation. roundness_phi = 2/delta and roundness_theta = 2/epsilon are OVITO's Superquadric
/// Roundness. The rounding of edges and the taper have no column, and a capsule is the ellipsoid of its size. A compound has an
/// atom per component. In scenes with compounds, mol is the number of the grain.
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
