// The end of a run as a still.
#pragma once

#include <filesystem>

#include "picture.hpp"

namespace falling_particles {

/// still.pov: the last frame for POV-Ray, whose superellipsoids are exact; a grain with rounded edges is a mesh; and
/// still.png, if there is a povray. Each kind has a colour (palette.hpp); of containers only the floor of a box is drawn, since
/// walls would hide the grains.
class PovrayScene final : public Picture {
 public:
  PovrayScene(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override { last_ = frame; }
  void finish(const std::string& summary) override;
  std::vector<Rendering> renderings() const override;

 private:
  std::filesystem::path path_;
  const Contents& contents_;
  Frame last_;
};

}  // namespace falling_particles
