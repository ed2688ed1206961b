// The last frame of a run as a POV-Ray scene.
#pragma once

#include <filesystem>

#include "picture.hpp"

namespace falling_particles {

/// still.pov: the last frame for POV-Ray, and still.png, if povray is installed. Superellipsoids are exact; a grain with rounded
/// edges is a mesh. Each kind has a colour (palette.hpp). Walls are transparent, except the floor and the dish.
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
