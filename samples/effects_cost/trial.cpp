#include "trial.hpp"

#include <chrono>

#include "random.hpp"
#include "stepper.hpp"
#include "world.hpp"

namespace effects_cost {

using falling_particles::Placement;
using falling_particles::Scene;

std::vector<Placement> settle(const Scene& scene) {
  falling_particles::Random random(scene.seed);
  std::vector<Placement> placements = place(scene, random);
  const falling_particles::World world(scene, placements);
  falling_particles::Stepper stepper(world, scene);
  for (int i = 0; i < scene.time.steps(); ++i) stepper.step();
  for (std::size_t i = 0; i < placements.size(); ++i) {
    const dReal* const q = dBodyGetQuaternion(world.bodies()[i].body);
    placements[i].position = world.bodies()[i].position();
    placements[i].quaternion = {q[0], q[1], q[2], q[3]};
  }
  return placements;
}

Outcome run(Scene scene, const std::vector<Placement>& start, const std::vector<supernormal::effects::Effect>& effects, int steps) {
  scene.effects = effects;
  const falling_particles::World world(scene, start);
  falling_particles::Stepper stepper(world, scene);
  stepper.step();  // what is made once
  const auto costs_before = stepper.costs();
  const auto rows = [&] {
    unsigned long long sum = 0;
    for (const auto& cost : world.effects().costs()) sum += cost.rows;
    return static_cast<double>(sum);
  };
  const double rows_before = rows();
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < steps; ++i) stepper.step();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto& costs = stepper.costs();
  return {seconds / steps, (costs.contact_setup.seconds() - costs_before.contact_setup.seconds()) / steps,
          (costs.solver.seconds() - costs_before.solver.seconds()) / steps,
          static_cast<double>(costs.contacts - costs_before.contacts) / steps, (rows() - rows_before) / steps};
}

}  // namespace effects_cost
