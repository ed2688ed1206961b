// Measures the final heap in the LAMMPS run of a scene, with the same measures as falling_particles.
//   heap_of_dump SCENE DUMP      (of falling_particles --to-lammps SCENE)
// prints the angle of repose and its standard error, in degrees, and the deepest overlap, relative to the smallest half-axis.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <variant>

#include "common/toml_string.hpp"
#include "model/scene.hpp"
#include "observe/bed.hpp"
#include "observe/energy.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

namespace {

using namespace falling_particles;

void print_heap(const std::string& scene_path, const std::string& dump_path) {
  const Scene scene = load_scene(scene_path, {"start.file=" + toml_string(std::filesystem::absolute(dump_path).string())});
  const auto* const hopper = std::get_if<Hopper>(&scene.container);
  if (hopper == nullptr || !hopper->dish) throw std::runtime_error(scene_path + " has no dish for a heap");
  Random random(scene.seed);
  World world(scene, place(scene, random));
  world.open_outlet();
  const Heap heap = measure_heap(world, {0, 0, hopper->dish->height}, hopper->dish->diameter / 2);
  std::printf("%.6g %.6g %.6g\n", heap.angle, heap.standard_error, measure_overlap(world).depth / scene.smallest_half_axis());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: heap_of_dump SCENE DUMP\n", stderr);
    return 2;
  }
  try {
    print_heap(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heap_of_dump: %s\n", error.what());
    return 1;
  }
  return 0;
}
