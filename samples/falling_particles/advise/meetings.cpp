// Walls that meet by their motions.

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "doubts.hpp"
#include "refusals.hpp"

namespace falling_particles {
namespace {

const Wall& wall_named(const std::string& name, const Scene& scene) { return *std::ranges::find(scene.walls, name, &Wall::name); }

/// s, from when on two walls that no drive moves have no space between them; empty if they always have.
std::optional<double> meeting_of(const FacingWalls& pair, const Scene& scene) {
  constexpr double kMost = 1e5;  // poses, which take 0.1 s
  const Wall& first = wall_named(pair[0], scene);
  const Wall& second = wall_named(pair[1], scene);
  if (first.drive || second.drive || (first.motions.empty() && second.motions.empty())) return std::nullopt;
  const double interval = std::max(scene.time.step, scene.time.duration / kMost);
  for (int i = 0; i * interval < scene.time.duration; ++i) {
    const double time = i * interval;
    const auto faces = facing_faces(first.shape, pose_at(first.start, first.motions, time), second.shape,
                                    pose_at(second.start, second.motions, time));
    if (!faces || faces->distance() <= 0) return time;
  }
  return std::nullopt;
}

}  // namespace

void refuse_meetings(const Scene& scene) {
  for (const Wall& wall : scene.walls) {
    if (!wall.drive || !wall.drive->servo) continue;
    for (const FacingWalls& pair : wall.drive->servo->between) {
      const std::optional<double> time = meeting_of(pair, scene);
      if (!time) continue;
      throw InputError(scene.called + ": the servo of " + wall.called() + " acts between \"" + pair[0] + "\" and \"" + pair[1] +
                       "\", which by their motions do not face each other, or have met, after " + rounded(*time) +
                       " s; allowed: motions whose until keeps them apart, or " + wall.key() + ".drive.area");
    }
  }
}

void add_doubts_about_meetings(const Scene& scene, std::vector<std::string>& doubts) {
  if (!std::holds_alternative<Cell>(scene.container)) return;
  for (const FacingWalls& pair : {FacingWalls{"x_low", "x_high"}, {"y_low", "y_high"}, {"z_low", "z_high"}}) {
    if (std::ranges::find(scene.walls, pair[1], &Wall::name) == scene.walls.end()) continue;
    const bool turns = std::ranges::any_of(pair, [&](const std::string& name) {
      return std::ranges::any_of(wall_named(name, scene).motions,
                                 [](const WallMotion& motion) { return std::holds_alternative<Rotation>(motion.kind); });
    });
    const std::optional<double> time = turns ? std::nullopt : meeting_of(pair, scene);
    if (!time) continue;
    doubts.push_back("walls \"" + pair[0] + "\" and \"" + pair[1] + "\" meet after " + rounded(*time) +
                     " s by their motions, and all grains leak; an until of their motions before that would do");
  }
}

}  // namespace falling_particles
