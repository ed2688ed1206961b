// Doubts: values of a scene that are probably mistakes.
#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// s; with longer steps, beds of grains that look ahead, or do not, sink and shake. README.md, "Before a run", has the measurement.
/// Infinite without gravity, and where springs or a compression act.
double longest_step(const Scene& scene, bool looks_ahead);

/// Whether an effect gives contacts a stiffness of their own.
bool has_springs(const Scene& scene);

std::string in_half_axes(double way, const Scene& scene);

/// A sentence about something that moves by more than a half-axis in a step, without its end: a remedy.
std::string moves_too_far(const std::string& who, double way, const Scene& scene);

/// A sentence for each doubt about a valid scene, with a remedy.
std::vector<std::string> doubts_about(const Scene& scene);

// By what may go wrong, each in a file of this name, but for bonds:

void add_doubts_about_step(const Scene& scene, std::vector<std::string>& doubts);
/// Of grains, and parts that press, which quickstep cannot hold on the lightest grains.
void add_doubts_about_loads(const Scene& scene, std::vector<std::string>& doubts);
/// Of walls that move too far in a step.
void add_doubts_about_walls(const Scene& scene, std::vector<std::string>& doubts);
/// Of grains that start above nothing or behind meshes.
void add_doubts_about_leaks(const Scene& scene, std::vector<std::string>& doubts);
/// Of bonds that may break, and are damped more by the step than the scene asks.
void add_doubts_about_bonds(const Scene& scene, std::vector<std::string>& doubts);

}  // namespace falling_particles
