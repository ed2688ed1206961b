// The animation of a run as a glTF file.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "output/picture.hpp"

namespace falling_particles {

/// scene.glb: glTF 2.0, binary. A mesh per kind of grain, through its normals, shared by its bodies; a node per body, in the
/// scene's order, scaled to its size, whose translation and rotation are animated where the body moves; a node per part of the
/// container, which is scaled where it changes; a root that turns z upwards. Lengths are in m. Written at the end of a run; until
/// then a body and frame take 28 bytes.
class SceneGlb final : public Picture {
 public:
  SceneGlb(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  void add_pose(std::size_t node, const Point& position, const std::array<double, 4>& quaternion);

  std::filesystem::path path_;
  Contents contents_;
  std::vector<float> times_;
  std::vector<std::vector<float>> translations_;  // of each body: x, y, z of every frame
  std::vector<std::vector<float>> rotations_;     // x, y, z, w
  std::vector<std::vector<float>> scales_;        // of each part of the container, along x, y, z
};

}  // namespace falling_particles
