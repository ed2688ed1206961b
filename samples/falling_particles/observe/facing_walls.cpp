#include "facing_walls.hpp"

#include <algorithm>
#include <cmath>

namespace falling_particles {
namespace {

const Wall& wall_named(const std::string& name, const std::vector<Wall>& walls) {
  return *std::ranges::find(walls, name, &Wall::name);
}

std::optional<FacingFaces> find_faces(const FacingWalls& pair, const std::vector<Wall>& walls) {
  const Wall& first = wall_named(pair[0], walls);
  const Wall& second = wall_named(pair[1], walls);
  return facing_faces(first.shape, first.start, second.shape, second.start);
}

}  // namespace

FacingFaces faces_at_start(const FacingWalls& pair, const std::vector<Wall>& walls) { return find_faces(pair, walls).value(); }

std::vector<FacingWalls> read_facing_walls(const TomlTable& table, const char* key, std::size_t count,
                                           const std::vector<Wall>& walls, const Vector3& across) {
  constexpr double kAcross = 1e-9;  // of a product of unit normals: rounding of orientations
  std::vector<std::string> all;
  all.reserve(walls.size());
  for (const Wall& wall : walls) all.push_back(wall.name);
  const std::vector<std::string> names = table.choices(key, all);
  const std::string allowed = "; allowed: " + std::to_string(count) +
                              " pairs of planes or boxes that face each other at right angles to the other pairs" +
                              (across.isZero() ? "" : " and to the axis of the drive");
  if (names.size() != 2 * count) {
    table.fail(key, table.full_name(key) + " has " + counted(names.size(), "wall") + allowed);
  }
  std::vector<FacingWalls> pairs;
  std::vector<Vector3> directions = {across};
  for (std::size_t i = 0; i < count; ++i) {
    const FacingWalls pair = {names[2 * i], names[2 * i + 1]};
    const std::optional<FacingFaces> faces = find_faces(pair, walls);
    const auto is_along = [&](const Vector3& other) { return std::abs(other.dot(faces->normal)) > kAcross; };
    if (!faces || faces->distance() <= 0 || std::ranges::any_of(directions, is_along)) {
      table.fail(key, table.full_name(key) + " has \"" + pair[0] + "\" and \"" + pair[1] + "\", which are no such pair" + allowed);
    }
    directions.push_back(faces->normal);
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace falling_particles
