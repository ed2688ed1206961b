// A run as ParaView reads it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "picture.hpp"

namespace falling_particles {

/// grains.pvd, contacts.pvd and container.pvd, which name the files of every frame in the folder vtk: VTK's XML format
/// for points, lines and polygons, as text.
///
/// A grain is a point with its kind (from 0 on, in the order of the scene file), quaternion (w, x, y, z), half-axes (m), exponents
/// (delta, epsilon), rounding (m), velocity (m/s) and angular velocity (rad/s); a contact one with its normal (unit, towards body
/// 1), depth (m), the two bodies (-1: a wall) and, where the scene asks for forces, the force on body 1 (N). The container's
/// triangles look at the grains; it has a new file when a part of it has changed. A compound has a point per part, and a capsule is
/// the ellipsoid of its size. In scenes with compounds, or where grains come or go (those that are not there are left out), `grain`
/// is the index of the grain that a point belongs to.
class VtkSeries final : public Picture {
 public:
  static constexpr std::string_view kFramesFolder = "vtk";  ///< within that of the results

  VtkSeries(const OutputFolder& folder, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  /// Writes a file of this frame and gives its name.
  std::string write(std::string_view what, const std::string& text) const;
  static void list(std::string& entries, double time, const std::string& name);
  std::string grains_of(const Frame& frame) const;

  std::filesystem::path grains_file_, contacts_file_, container_file_, frames_folder_;
  const Contents& contents_;
  std::string grains_, contacts_, containers_;  // entries of the lists
  std::string container_;                       // file of the container as it is
  std::vector<WallPlace> wall_places_;          // of its parts as it was written
  int frames_ = 0;
};

}  // namespace falling_particles
