// Measures the final heap in the LAMMPS run of a scene, with the same measures as falling_particles.
//   heap_of_dump SCENE DUMP      (of falling_particles --to-lammps SCENE)
// prints the angle of repose and its standard error, in degrees, and the deepest overlap, relative to the smallest half-axis.
#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "model/scene.hpp"
#include "observe/heap.hpp"
#include "observe/overlap.hpp"
#include "world/world.hpp"

namespace {

using namespace falling_particles;

/// Reads the placement of a grain from a line of the dump: `id`, `type`, position, diameters, and quaternion with the real part
/// last.
Placement read_grain(const std::string& line, const Scene& scene, int& id) {
  std::istringstream words(line);
  std::size_t type = 0;
  Placement grain{};
  std::array<double, 3> diameters{};
  words >> id >> type;
  for (double& x : grain.position) words >> x;
  for (double& diameter : diameters) words >> diameter;
  for (const std::size_t k : {1, 2, 3, 0}) words >> grain.quaternion.at(k);
  if (!words || type < 1 || type > scene.kinds.size()) throw std::runtime_error("no line of a grain of the scene: " + line);
  grain.kind = type - 1;
  grain.scale = diameters[0] / 2 / scene.kinds[grain.kind].kind.half_axes[0];
  return grain;
}

/// The grains of the last frame, sorted by id.
std::vector<Placement> read_last_frame(const std::string& path, const Scene& scene) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::map<int, Placement> grains;
  bool are_grains = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("ITEM:")) {
      are_grains = line.starts_with("ITEM: ATOMS");
      if (are_grains) grains.clear();
    } else if (are_grains) {
      int id = 0;
      const Placement grain = read_grain(line, scene, id);
      grains[id] = grain;
    }
  }
  std::vector<Placement> in_order;
  in_order.reserve(grains.size());
  for (const auto& [id, grain] : grains) in_order.push_back(grain);
  return in_order;
}

void print_heap(const std::string& scene_path, const std::string& dump_path) {
  const Scene scene = load_scene(scene_path);
  const auto* const hopper = std::get_if<Hopper>(&scene.container);
  if (hopper == nullptr || !hopper->dish) throw std::runtime_error(scene_path + " has no dish for a heap");
  World world(scene, read_last_frame(dump_path, scene));
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
