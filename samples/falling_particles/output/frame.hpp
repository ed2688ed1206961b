// What a picture shows of a run.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "model/geometry.hpp"
#include "model/scene.hpp"
#include "observe/container_picture.hpp"
#include "observe/energy.hpp"

namespace falling_particles {

class Stepper;
class World;

/// A body at one time, in the world's frame.
struct GrainState {
  Point position;                    ///< m, of the centre
  std::array<double, 4> quaternion;  ///< w, x, y, z; unit: from the body's frame to the world's
  Point velocity;                    ///< m/s
  Point angular_velocity;            ///< rad/s
  bool is_present = true;            ///< false for a grain that is gone, whose other numbers are 0

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(position, quaternion, velocity, angular_velocity, is_present);
  }
};

/// A contact of the last step, in the world's frame.
struct ContactState {
  Point position;  ///< m
  Point normal;    ///< unit, towards body 1, as in dContactGeom
  double depth;    ///< m
  int grain1;      ///< index of the body; kWall for a wall
  int grain2;
  std::optional<Point> force = {};  ///< N, on body 1; where the scene asks for forces

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(position, normal, depth, grain1, grain2, force);
  }
};

inline constexpr int kWall = -1;

/// Where a part of the container is: its mesh is scaled, turned and moved.
struct WallPlace {
  Point position = {};                              ///< m
  std::array<double, 4> quaternion = {1, 0, 0, 0};  ///< w, x, y, z; unit
  double scale = 1;                                 ///< 0: the part is gone

  Point operator()(const std::array<float, 3>& vertex) const;
  bool operator==(const WallPlace&) const = default;

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(position, quaternion, scale);
  }
};

/// One moment of a run. The bodies are all that there have been so far, by their indices, those that are gone included.
struct Frame {
  double time = 0;  ///< s
  Energy energy{};
  std::vector<GrainState> grains;
  std::vector<ContactState> contacts;  ///< of the step that led to this moment; none at the start. Those of a pair are consecutive
  std::vector<WallPlace> wall_places;  ///< of the container's parts

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(time, energy, grains, contacts, wall_places);
  }
};

/// A box along the axes.
struct Extent {
  Point least, most;  ///< m
};

/// The least box around spheres of that radius (m) about the bodies that are there; about the origin when none is.
Extent extent_of(const Frame& frame, double radius);

/// What a run shows, which does not change from frame to frame but for the grains that come. The scene must outlive it.
struct Contents {
  const Scene* scene;
  std::vector<std::size_t> kind_of_grain;   ///< index into scene->grains, of all that there have been so far
  std::vector<WallPicture> walls = {};      ///< of the container, then those of the scene
  std::vector<double> scale_of_grain = {};  ///< of the grain's lengths; none where all are 1

  const GrainKind& kind(std::size_t grain) const { return scene->kinds[kind_of_grain[grain]].kind; }
  double scale(std::size_t grain) const { return scale_of_grain.empty() ? 1 : scale_of_grain[grain]; }
};

/// m, above all grains of a run that has not started, and above its feeders: up to there walls without end are shown.
double top_of(const World& world, const Scene& scene);

Contents contents_of(const World& world, const Scene& scene, double top);
/// Of a run that has not started.
Contents contents_of(const World& world, const Scene& scene);

/// Appends the grains that have come since.
void add_new_grains(Contents& contents, const World& world);

/// `stepper`: null at the start, before the first step.
Frame frame_of(double time, const Energy& energy, const Contents& contents, const World& world, const Stepper* stepper);

}  // namespace falling_particles
