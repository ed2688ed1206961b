// How far grains move in a step.
#pragma once

#include <optional>
#include <string>

#include "model/scene.hpp"

namespace falling_particles {

/// The fall along gravity from the start to the end of the container, without drag and contacts; down an open container to the
/// lowest start.
struct Fall {
  double height;  ///< m, along gravity
  double speed;   ///< m/s, at the end of the fall
  double way;     ///< m, in a step at the end of the fall
};

/// Empty if grains do not fall, or have no end of their fall: without gravity, without grains at the start, from a state, in a
/// periodic container, and where the container is open.
std::optional<Fall> fall_from_start(const Scene& scene);

/// Whether the effect gives contacts a stiffness of their own.
bool is_spring(const supernormal::effects::Effect& effect);
bool has_springs(const Scene& scene);

std::string in_half_axes(double way, const Scene& scene);

/// A sentence about something that moves by more than a half-axis in a step, without its end: a remedy.
std::string moves_too_far(const std::string& who, double way, const Scene& scene);

}  // namespace falling_particles
