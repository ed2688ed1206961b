#include "container_picture.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace falling_particles {
namespace {

using Role = WallPicture::Role;

std::array<float, 3> vertex(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

/// The corners of the plan at two heights, the lower ones first, anticlockwise from the lowest x and y.
std::vector<std::array<float, 3>> corners_of(const Rectangle& plan, double bottom, double top) {
  const auto [x, y] = plan.corner;
  const auto [dx, dy] = plan.width;
  std::vector<std::array<float, 3>> corners;
  for (const double z : {bottom, top}) {
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) corners.push_back(vertex(x + i * dx, y + j * dy, z));
  }
  return corners;
}

WallPicture floor_of(const Rectangle& plan, double z) {
  WallPicture wall{"floor", Role::Still, {corners_of(plan, z, z), {{0, 1, 2}, {0, 2, 3}}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
  wall.mesh.vertices.resize(4);
  return wall;
}

WallPicture walls_around(const Rectangle& plan, double bottom, double top, const PeriodicAxes& periodic = {}) {
  WallPicture wall{"walls", Role::Still, {corners_of(plan, bottom, top), {}}, {}};
  for (unsigned int side = 0; side < 4; ++side) {
    const unsigned int next = (side + 1) % 4;
    if (periodic[(side + 1) % 2]) continue;                     // side 0 is across y
    wall.mesh.triangles.push_back({side, side + 4, next + 4});  // seen from inside
    wall.mesh.triangles.push_back({side, next + 4, next});
    wall.edges.push_back({side, side + 4});
    wall.edges.push_back({side + 4, next + 4});
  }
  return wall;
}

std::vector<WallPicture> pictures_of(const Box& box, double top, const PeriodicAxes& periodic = {}) {
  std::vector<WallPicture> walls = {floor_of(box.plan(), 0)};
  if (!periodic[0] || !periodic[1]) walls.push_back(walls_around(box.plan(), 0, top, periodic));
  return walls;
}

/// The edges of the first `rings` rings that make_mesh() stacks.
std::vector<std::array<unsigned int, 2>> ring_edges(int segments, unsigned int rings) {
  const auto sides = static_cast<unsigned int>(segments);
  std::vector<std::array<unsigned int, 2>> edges;
  for (unsigned int ring = 0; ring < rings; ++ring) {
    for (unsigned int side = 0; side < sides; ++side) edges.push_back({ring * sides + side, ring * sides + (side + 1) % sides});
  }
  return edges;
}

/// The part of the lid's plane that closes the outlet: the polygon of the hopper's lowest ring.
WallPicture lid_of(const Hopper& hopper) {
  WallPicture wall{"lid", Role::Lid, make_mesh(hopper), ring_edges(hopper.segments, 1)};
  wall.mesh.vertices.resize(static_cast<std::size_t>(hopper.segments));
  wall.mesh.triangles.clear();
  for (unsigned int side = 1; side + 1 < static_cast<unsigned int>(hopper.segments); ++side) {
    wall.mesh.triangles.push_back({0, side, side + 1});
  }
  return wall;
}

std::vector<WallPicture> pictures_of(const Hopper& hopper, double /*top*/) {
  const Rectangle tray = hopper.tray();
  std::vector<WallPicture> walls = {floor_of(tray, 0), walls_around(tray, 0, hopper.clearance), lid_of(hopper)};
  walls.push_back({"hopper", Role::Still, make_mesh(hopper), ring_edges(hopper.segments, 3)});
  if (hopper.dish) {
    walls.push_back({"dish", Role::Still, make_mesh(*hopper.dish, hopper.segments), ring_edges(hopper.segments, 4)});
  }
  return walls;
}

/// The ground between the walls: all samples but the outermost, which lie beyond the walls.
WallPicture ground_of(const Terrain& terrain) {
  WallPicture wall{"ground", Role::Still, {}, {}};
  const auto side = static_cast<unsigned int>(terrain.samples_per_side() - 2);
  const auto [dx, dy] = terrain.spacing();
  for (unsigned int j = 0; j < side; ++j) {
    for (unsigned int i = 0; i < side; ++i) wall.mesh.vertices.push_back(vertex(i * dx, j * dy, terrain.sample(i + 1, j + 1)));
  }
  for (unsigned int j = 0; j + 1 < side; ++j) {
    for (unsigned int i = 0; i + 1 < side; ++i) {
      const unsigned int lowest = j * side + i, highest = lowest + side + 1;
      wall.mesh.triangles.push_back({lowest, lowest + 1, highest});
      wall.mesh.triangles.push_back({lowest, highest, lowest + side});
    }
  }
  return wall;
}

std::vector<WallPicture> pictures_of(const Terrain& terrain, double top) {
  WallPicture ground = ground_of(terrain);
  const auto below = [](const auto& a, const auto& b) { return a[2] < b[2]; };
  const double lowest = std::ranges::min_element(ground.mesh.vertices, below)->at(2);
  return {std::move(ground), walls_around(terrain.plan(), lowest, top)};
}

std::vector<WallPicture> pictures_of(const Periodic&, double /*top*/) {
  WallPicture cell{"cell", Role::Cell, {corners_of({{0, 0}, {1, 1}}, 0, 1), {}}, {}};
  for (unsigned int side = 0; side < 4; ++side) {
    const unsigned int next = (side + 1) % 4;
    cell.edges.insert(cell.edges.end(), {{side, next}, {side, side + 4}, {side + 4, next + 4}});
  }
  return {std::move(cell)};
}

/// For containers whose walls are in Scene::walls.
template <typename MadeOfWalls>
std::vector<WallPicture> pictures_of(const MadeOfWalls&, double /*top*/) {
  return {};
}

}  // namespace

std::vector<WallPicture> pictures_of(const Container& container, double top, const PeriodicAxes& periodic) {
  if (const Box* box = std::get_if<Box>(&container)) return pictures_of(*box, top, periodic);
  return std::visit([top](const auto& kind) { return pictures_of(kind, top); }, container);
}

}  // namespace falling_particles
