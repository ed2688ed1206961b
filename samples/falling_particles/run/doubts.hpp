// What a scene says that its author can hardly mean.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

/// The fall of the highest grain of the start to the lowest place where grains may start, without drag and contacts.
struct Fall {
  double height;  ///< m
  double speed;   ///< m/s, at its end
  double way;     ///< m, in a step
};

/// Empty where grains do not fall: without gravity or grains at the start, or in a periodic container.
std::optional<Fall> fall_from_start(const Scene& scene);

/// s, up to which steps leave overlaps of some 1e-3 of the smallest half-axis in a bed at rest, for grains that look ahead under
/// gravity; empty for others, and for springs, which have a time of their own.
std::optional<double> step_for_look_ahead(const Scene& scene);

/// m, the farthest way in a step that a motion of the part takes a place of its surface along the surface's normal. Motions count
/// together, as if their largest velocities came at once.
double normal_way_of(const Wall& wall, const Scene& scene);

/// A sentence for each doubt about a scene that can be run, with what would settle it.
std::vector<std::string> doubts_about(const Scene& scene);

/// Throws InputError when a grain of the start overlaps a part: it would be pushed out, on any side, or never.
void refuse_overlapping_start(const Scene& scene);

}  // namespace falling_particles
