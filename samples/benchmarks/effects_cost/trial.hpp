// A bed of grains that is stepped with a choice of effects, and the time that this takes.
#pragma once

#include <supernormal/effects.hpp>
#include <vector>

#include "model/scene.hpp"
#include "world/placement.hpp"

namespace effects_cost {

/// The mean cost of a step of a scene, in seconds of the processor.
struct Outcome {
  double seconds = 0;  ///< s, whole step
  double set_up = 0;   ///< s, preparing contacts and forces: the effects' passes and the joints
  double solver = 0;   ///< s, dWorldQuickStep
  double contacts = 0;
  double rows = 0;
};

/// Runs the scene to its end and returns where its grains lie then.
std::vector<falling_particles::Placement> settle(const falling_particles::Scene& scene);

/// Steps from there, from rest, with other effects. The steps must be few, so that the bed stays as it is.
Outcome run(falling_particles::Scene scene, const std::vector<falling_particles::Placement>& start,
            const std::vector<supernormal::effects::Effect>& effects, int steps);

}  // namespace effects_cost
