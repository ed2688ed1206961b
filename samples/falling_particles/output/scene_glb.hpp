// The animation of a run as a glTF file.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "picture.hpp"

namespace falling_particles {

/// scene.glb: glTF 2.0, binary. A mesh per kind of grain, through its normals, shared by its bodies; a node per body, by its index,
/// scaled to its size, whose translation and rotation are animated where the body moves, and which is scaled to nothing while it is
/// not there; a node per part of the container, which is scaled where it changes; a root that turns z upwards. Lengths are in m.
/// Written at the end of a run; until then a body and frame take 28 bytes.
class SceneGlb final : public Picture {
 public:
  SceneGlb(const std::filesystem::path& path, const Contents& contents);
  void add(const Frame& frame) override;
  void finish(const std::string& summary) override;

 private:
  /// The poses of a node, frame by frame.
  struct Track {
    std::vector<float> translations;  // x, y, z
    std::vector<float> rotations;     // x, y, z, w
    std::vector<float> scales;        // along x, y, z

    void add(const Point& position, const std::array<double, 4>& quaternion, double scale);
    void repeat_last(double scale);
    /// Puts `frames` before the first one, in which the node is not there.
    void precede(std::size_t frames);
  };
  void add_grain(std::size_t grain, const GrainState& state);

  std::filesystem::path path_;
  const Contents& contents_;
  std::vector<float> times_;
  std::vector<Track> grains_;
  std::vector<Track> walls_;  // of the container
};

}  // namespace falling_particles
