#include "container.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <variant>

namespace falling_particles {
namespace {

Wall side(std::string name, WallShape shape, const Vector3& position = Vector3::Zero()) {
  Wall wall{std::move(name), std::move(shape), {position, Eigen::Quaterniond::Identity()}};
  wall.role = WallRole::Side;
  return wall;
}

Wall plane(std::string name, const Vector3& position, const Vector3& normal) {
  return side(std::move(name), PlaneShape{0, normal}, position);
}

Wall floor() { return plane("floor", Vector3::Zero(), Vector3::UnitZ()); }

/// Four walls of infinite height around a rectangle.
void add_sides(const Rectangle& plan, std::vector<Wall>& walls) {
  const auto [x, y] = plan.corner;
  walls.push_back(plane("x_low", {x, 0, 0}, Vector3::UnitX()));
  walls.push_back(plane("x_high", {x + plan.width[0], 0, 0}, {-1, 0, 0}));
  walls.push_back(plane("y_low", {0, y, 0}, Vector3::UnitY()));
  walls.push_back(plane("y_high", {0, y + plan.width[1], 0}, {0, -1, 0}));
}

std::vector<Wall> walls_of(const Box& box) {
  std::vector<Wall> walls = {floor()};
  add_sides(box.plan(), walls);
  return walls;
}

std::vector<Wall> walls_of(const Hopper& hopper) {
  std::vector<Wall> walls = {floor()};
  add_sides(hopper.tray(), walls);
  if (hopper.opens_at > 0) {
    walls.push_back(plane("lid", {0, 0, hopper.clearance}, Vector3::UnitZ()));
    walls.back().role = WallRole::Lid;
  }
  walls.push_back(side("hopper", MeshShape{make_mesh(hopper)}));
  if (hopper.dish) walls.push_back(side("dish", MeshShape{make_mesh(*hopper.dish, hopper.segments)}));
  return walls;
}

std::vector<Wall> walls_of(const Terrain& terrain) {
  const Rectangle plan = terrain.plan();
  std::vector<Wall> walls;
  add_sides(plan, walls);
  walls.push_back(side("ground", GroundShape{terrain.samples_per_side(), terrain.spacing(), terrain.samples()},
                       {plan.corner[0] + plan.width[0] / 2, plan.corner[1] + plan.width[1] / 2, 0}));
  return walls;
}

/// The inner side of the drum's shell around the y-axis. It extends beyond both ends.
MeshShape shell_of(const Drum& drum) {
  MeshShape mesh;
  const double beyond = 0.1 * drum.radius();
  const auto count = static_cast<unsigned int>(drum.segments);
  for (const double y : {-beyond, drum.length + beyond}) {
    for (unsigned int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / count;
      mesh.vertices.push_back({static_cast<float>(drum.outer_radius() * std::sin(angle)), static_cast<float>(y),
                               static_cast<float>(-drum.outer_radius() * std::cos(angle))});
    }
  }
  for (unsigned int i = 0; i < count; ++i) {
    const unsigned int next = (i + 1) % count;
    mesh.triangles.push_back({i, next, next + count});
    mesh.triangles.push_back({i, next + count, i + count});
  }
  return mesh;
}

WallPose facing(const Vector3& position, double angle_about_x) {
  return {position, Eigen::Quaterniond(Eigen::AngleAxisd(angle_about_x, Vector3::UnitX()))};
}

std::vector<Wall> walls_of(const Drum& drum) {
  const Rotation turn{Vector3::UnitY(), {0, 0, drum.radius()}, drum.rpm};
  const std::vector<WallMotion> motions = {{turn, drum.turns_at}};
  const PlaneShape end{drum.outer_radius()};
  return {{"drum", shell_of(drum), {{0, 0, drum.radius()}, Eigen::Quaterniond::Identity()}, motions},
          {"near_end", end, facing({0, 0, drum.radius()}, -std::numbers::pi / 2), motions},
          {"far_end", end, facing({0, drum.length, drum.radius()}, std::numbers::pi / 2), motions}};
}

// The floor of a cell has the name of the lower end along z.
std::vector<Wall> walls_of(const Cell& cell) {
  std::vector<Wall> walls;
  add_sides(cell.plan(), walls);
  walls.push_back(plane("z_low", {0, 0, cell.lowest()}, Vector3::UnitZ()));
  if (cell.has_lid()) walls.push_back(plane("z_high", {0, 0, cell.ceiling()}, {0, 0, -1}));
  for (Wall& wall : walls) wall.role = WallRole::Part;
  return walls;
}

}  // namespace

const char* kind_of(const Container& container) {
  constexpr std::array kKinds = {"box", "hopper", "terrain", "periodic", "none", "drum", "cell"};
  return kKinds[container.index()];
}

Rectangle plan_of(const Container& container) {
  return std::visit([](const auto& kind) { return kind.plan(); }, container);
}

bool is_open(const Container& container) {
  return std::holds_alternative<Open>(container) || std::holds_alternative<Cell>(container);
}

double lowest_start(const Container& container) {
  return std::visit([](const auto& kind) { return kind.lowest(); }, container);
}

double ceiling_of(const Container& container) {
  const auto ceiling = [](const auto& kind) {
    if constexpr (requires { kind.ceiling(); }) return kind.ceiling();
    return double{INFINITY};
  };
  return std::visit(ceiling, container);
}

bool has_room(const Container& container, const Point& lower, const Point& size) {
  const auto room = [&](const auto& kind) {
    if constexpr (requires { kind.has_room(lower, size); }) return kind.has_room(lower, size);
    return true;  // the plan leaves out the walls, so nothing else can obstruct a cell above it
  };
  return std::visit(room, container);
}

Region room_of(const Container& container) {
  return std::visit([](const auto& kind) -> Region { return kind.room(); }, container);
}

bool contains(const Container& container, const Point& point) {
  return std::visit([&point](const auto& kind) { return kind.contains(point); }, container);
}

std::vector<Wall> walls_in(const Container& container) {
  const auto walls = [](const auto& kind) -> std::vector<Wall> {
    if constexpr (requires { walls_of(kind); }) return walls_of(kind);
    return {};
  };
  std::vector<Wall> found = std::visit(walls, container);
  for (Wall& wall : found) wall.is_of_container = true;
  return found;
}

}  // namespace falling_particles
