// A run as a LAMMPS dump.

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <string>

#include "base/write_file.hpp"
#include "common/interval.hpp"
#include "frame.hpp"
#include "picture.hpp"

namespace falling_particles {
namespace {

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

/// The bounds of the box that a dump needs.
std::string bounds_of(const Extent& extent) {
  std::string lines;
  for (std::size_t axis = 0; axis < 3; ++axis) lines += shortest(extent.least[axis]) + ' ' + shortest(extent.most[axis]) + '\n';
  return lines;
}

void append(std::string& line, std::initializer_list<double> numbers) {
  for (const double number : numbers) line += ' ' + shortest(number);
}

}  // namespace

LammpsDump::LammpsDump(const std::filesystem::path& path, const Contents& contents) : contents_(contents), file_(path) {}

void LammpsDump::add(const Frame& frame) {
  const std::vector<ShownComponent> components = shown_components(frame, contents_);
  const bool has_compounds = contents_.scene->has_compounds();
  std::string text = "ITEM: TIMESTEP\n" + std::to_string(frames_++) + "\nITEM: TIME\n" + shortest(frame.time) +
                     "\nITEM: NUMBER OF ATOMS\n" + std::to_string(components.size()) + "\nITEM: BOX BOUNDS ff ff ff\n" +
                     bounds_of(extent_of(frame, contents_.scene->largest_bounding_radius())) +
                     "ITEM: ATOMS id type x y z vx vy vz omegax omegay omegaz quati quatj quatk quatw shapex shapey shapez "
                     "roundness_phi roundness_theta" +
                     (has_compounds ? " mol\n" : "\n");
  for (const ShownComponent& component : components) {
    const auto& [a, b, c] = component.body.half_axes;
    const auto& [w, x, y, z] = component.quaternion;
    text += std::to_string(component.index + 1) + ' ' + std::to_string(contents_.kind_of_grain[component.grain] + 1);
    for (const Point* vector : {&component.position, &component.velocity, &component.angular_velocity})
      append(text, {(*vector)[0], (*vector)[1], (*vector)[2]});
    append(text, {x, y, z, w, 2 * a, 2 * b, 2 * c, 2 / component.body.delta, 2 / component.body.epsilon});
    if (has_compounds) text += ' ' + std::to_string(component.grain + 1);
    text += '\n';
  }
  file_.write(text);
}

void LammpsDump::finish(const std::string& /*summary*/) { file_.close(); }

PictureFormat lammps_format() { return {"lammps", {"grains.lammpstrj"}, make_file<LammpsDump>}; }

}  // namespace falling_particles
