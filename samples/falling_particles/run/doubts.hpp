// Doubts: values of a scene that are probably mistakes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/scene.hpp"

namespace falling_particles {

class World;

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

/// s, the longest step with overlaps of about 1e-3 of the smallest half-axis in a bed at rest, for grains that look ahead under
/// gravity. Empty for other grains, and for springs, which have a time scale of their own.
std::optional<double> step_for_look_ahead(const Scene& scene);

/// m, the largest displacement of a point of the wall's surface along its normal in a step. The largest velocities of all motions
/// are added.
double normal_way_of(const Wall& wall, const Scene& scene);

/// m, the displacement of a driven wall in its first step, from rest without resistance; of its farthest point if it turns.
double first_way_of(const Wall& wall, double step);

/// A sentence about something that moves by more than a half-axis in a step, without its end: a remedy.
std::string moves_too_far(const std::string& who, double way, const Scene& scene);

/// A sentence for each doubt about a valid scene, with a remedy.
std::vector<std::string> doubts_about(const Scene& scene);

/// Sentences about grains of the start and of feeders that start behind meshes, above nothing, behind servos, or where there is no
/// space for them (origins.cpp).
std::vector<std::string> doubts_about_origins(const Scene& scene);

/// Sentences about bonds and walls that do not go on where the run has left them that wrote the state of the start
/// (continuation.cpp).
std::vector<std::string> doubts_about_continuation(const Scene& scene);

/// Sentences about measurements whose box or plane no grain reaches (reach.cpp).
std::vector<std::string> doubts_about_measurements(const Scene& scene);

/// Sentences about opposite sides of a cell that meet by their motions (meetings.cpp).
std::vector<std::string> doubts_about_meetings(const Scene& scene);

/// Throws InputError if two walls, between which a servo acts, meet by their motions (meetings.cpp).
void refuse_meetings(const Scene& scene);

/// Sentences about springs of contacts that last fewer than ten steps (springs.cpp). A run counts these contacts as coarse.
std::vector<std::string> doubts_about_springs(const Scene& scene);

/// Throws InputError when a grain of the start overlaps a wall. It would be pushed out on either side, or not at all. The grains of
/// a state may overlap one another and walls by StartState::overlap, and must be within the container.
void refuse_overlapping_start(const Scene& scene);

/// The same for the grains of a state (start_check.cpp). This and the following checks take a world at the start.
void refuse_bad_state(const World& world);

/// Throws InputError if a section [[bond]] bonds nothing, or if its bonds are too stiff. The scene has bonds.
void refuse_bad_bonds(const World& world);

/// Throws InputError if bonds are too stiff for the step and this number of iterations of the solver. The scene has bonds. The
/// world may have made steps.
void refuse_stiff_bonds(const World& world, int iterations);

/// Throws InputError if a free wall overlaps another wall, beside a state by more than StartState::overlap. Both would be pushed
/// apart.
void refuse_bad_flights(const World& world);

}  // namespace falling_particles
