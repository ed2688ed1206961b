// A run as ParaView reads it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "output/picture.hpp"

namespace falling_particles {

/// grains.pvd and contacts.pvd, which name the files of every frame in the folder vtk: VTK's XML format for points, as text.
///
/// A grain is a point with its kind (from 0 on, in the order of the scene file), quaternion (w, x, y, z), half-axes (m), exponents
/// (delta, epsilon), rounding (m), velocity (m/s) and angular velocity (rad/s); a contact one with its normal (unit, towards body
/// 1), depth (m) and the two bodies (-1: a wall).
class VtkSeries final : public Picture {
 public:
  VtkSeries(const OutputFolder& folder, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  void write_frame(std::string_view what, double time, const std::string& text, std::string& list) const;
  std::string grains_of(const Frame& frame) const;

  std::filesystem::path grains_file_, contacts_file_, frames_folder_;
  Contents contents_;
  std::string grains_, contacts_;  // entries of the two lists
  int frames_ = 0;
};

}  // namespace falling_particles
