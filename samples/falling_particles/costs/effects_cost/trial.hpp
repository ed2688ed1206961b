// Steps a bed of grains with a choice of effects and measures the time.
#pragma once

#include <supernormal/effects.hpp>
#include <vector>

#include "model/scene.hpp"
#include "world/placement.hpp"

namespace effects_cost {

/// The mean cost of a step of a scene, in processor time.
struct Outcome {
  double seconds = 0;  ///< s, whole step
  double set_up = 0;   ///< s, preparation of contacts and forces: the passes of the effects, and the joints
  double solver = 0;   ///< s, dWorldQuickStep
  double contacts = 0;
  double rows = 0;
};

/// Runs the scene to its end and returns the final placements of its grains.
std::vector<falling_particles::Placement> settle(const falling_particles::Scene& scene);

/// Steps from these placements, from rest, with other effects. Use few steps, so that the bed does not change.
Outcome run(falling_particles::Scene scene, const std::vector<falling_particles::Placement>& start,
            const std::vector<supernormal::effects::Effect>& effects, int steps);

}  // namespace effects_cost
