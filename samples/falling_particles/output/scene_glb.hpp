// The animation of a run as a glTF file.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "picture.hpp"

namespace falling_particles {

/// scene.glb: glTF 2.0, binary. It has a mesh per kind of grain with smooth normals. Each grain is a node, in the order of the
/// indices, with the mesh of its kind and a scale for its size. The translations and rotations of moving grains are animated;
/// absent grains have scale 0. Each wall is a node, which is scaled when it changes. A root node rotates the z-axis upwards.
/// A wall has the colours and numbers of the first field with numbers on it, at the end of the run.
/// Lengths are in m. The file is written at the end of a run; until then a grain needs 28 bytes per frame.
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
    /// Inserts `frames` frames before the first one; in these the node is absent.
    void precede(std::size_t frames);
  };
  void add_grain(std::size_t grain, const GrainState& state);

  std::filesystem::path path_;
  const Contents& contents_;
  std::vector<float> times_;
  std::vector<Track> grains_;
  std::vector<Track> walls_;           // of the walls
  std::vector<TriangleField> fields_;  // of the last frame
};

}  // namespace falling_particles
