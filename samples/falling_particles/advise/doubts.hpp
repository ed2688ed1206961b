// Doubts: values of a scene that are probably mistakes.
#pragma once

#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

/// A sentence for each doubt about a valid scene, with a remedy.
std::vector<std::string> doubts_about(const Scene& scene);

// By what may go wrong, each in a file of this name, but for units and bonds:

void add_doubts_about_step(const Scene& scene, std::vector<std::string>& doubts);
/// Of contacts that last fewer than ten steps. A run counts these as coarse.
void add_doubts_about_springs(const Scene& scene, std::vector<std::string>& doubts);
/// Of grains, and parts that press, which quickstep cannot hold on the lightest grains.
void add_doubts_about_loads(const Scene& scene, std::vector<std::string>& doubts);
/// Of walls that move too far in a step.
void add_doubts_about_walls(const Scene& scene, std::vector<std::string>& doubts);
/// Of grains that start above nothing or behind meshes.
void add_doubts_about_leaks(const Scene& scene, std::vector<std::string>& doubts);
/// Of a container a thousand grains wide.
void add_doubts_about_units(const Scene& scene, std::vector<std::string>& doubts);
/// Of bonds that may break, and are damped more by the step than the scene asks.
void add_doubts_about_bonds(const Scene& scene, std::vector<std::string>& doubts);
/// Of opposite sides of a cell that meet by their motions.
void add_doubts_about_meetings(const Scene& scene, std::vector<std::string>& doubts);

}  // namespace falling_particles
