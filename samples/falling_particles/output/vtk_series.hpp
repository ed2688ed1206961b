// A run as files for ParaView.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "picture.hpp"

namespace falling_particles {

/// grains.pvd, contacts.pvd and container.pvd list the files of every frame in the folder vtk. These are in VTK's XML format for
/// points, lines and polygons, as text.
///
/// A grain is a point with its kind (from 0, in the order of the scene file), quaternion (w, x, y, z), half-axes (m), exponents
/// (delta, epsilon), rounding (m), velocity (m/s) and angular velocity (rad/s). A compound has a point per component. A capsule
/// is the ellipsoid of its size. In scenes with compounds, feeders or sinks, `grain` is the index of the point's grain. Absent
/// grains are left out. A contact is a point with its normal (unit, towards grain 1), depth (m) and the two grains (-1: a wall). If
/// the scene requests forces, it has the force on grain 1 (N). The container's triangles face the grains, and have the
/// fields of measurements; there is a new file whenever a wall has changed.
class VtkSeries final : public Picture {
 public:
  static constexpr std::string_view kFramesFolder = "vtk";  ///< within the folder of the results

  VtkSeries(const OutputFolder& folder, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  /// Writes a file of this frame and returns its name.
  std::string write(std::string_view what, const std::string& text) const;
  static void list(std::string& entries, double time, const std::string& name);
  std::string grains_of(const Frame& frame) const;

  std::filesystem::path grains_file_, contacts_file_, container_file_, frames_folder_;
  const Contents& contents_;
  std::string grains_, contacts_, containers_;  // entries of the lists
  std::string container_;                       // the latest file of the container
  std::vector<WallPlace> wall_places_;          // of the walls in this file
  std::vector<TriangleField> fields_;           // on the walls in this file
  int frames_ = 0;
};

}  // namespace falling_particles
