#include "watches.hpp"

#include <variant>

namespace falling_particles {

Watches::Watches(World& world, const Scene& scene, Random& random) : leaks(world, scene), energy(world, scene) {
  if (const Hopper* hopper = std::get_if<Hopper>(&scene.container)) discharge.emplace(world, *hopper, random);
  if (scene.compression) compressor.emplace(world, *world.cell(), *scene.compression, scene.time.duration);
}

}  // namespace falling_particles
