#pragma once

#include <supernormal/effects.hpp>
#include <vector>

#include "scene/scene.hpp"
#include "simulation/placement.hpp"

namespace effects_cost {

/// What a step of a scene cost, on average; seconds of the processor.
struct Outcome {
  double seconds = 0;  ///< whole
  double set_up = 0;   ///< s, contacts and forces made ready: the effects' passes and the joints
  double solver = 0;   ///< s, dWorldQuickStep
  double contacts = 0;
  double rows = 0;
};

/// Lets the scene run to its end; where its grains lie then.
std::vector<falling_particles::Placement> settle(const falling_particles::Scene& scene);

/// Steps from there, at rest, with other effects. Few steps: the bed is to stay what it is.
Outcome run(falling_particles::Scene scene, const std::vector<falling_particles::Placement>& start,
            const std::vector<supernormal::effects::Effect>& effects, int steps);

}  // namespace effects_cost
