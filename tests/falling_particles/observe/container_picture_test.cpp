// Tests of what pictures show of containers: the triangles are where the walls are, and look at the grains.
#include "observe/container_picture.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

using namespace falling_particles;

namespace {

using Eigen::Vector3d;

Vector3d corner(const Mesh& mesh, unsigned int index) {
  const auto& [x, y, z] = mesh.vertices.at(index);
  return {x, y, z};
}

const WallPicture& find(const std::vector<WallPicture>& pictures, const std::string& name) {
  const auto found = std::ranges::find(pictures, name, &WallPicture::name);
  REQUIRE(found != pictures.end());
  return *found;
}

/// Whether all triangles of the part look at the point.
bool looks_at(const WallPicture& wall, const Vector3d& point) {
  return std::ranges::all_of(wall.mesh.triangles, [&](const auto& triangle) {
    const Vector3d a = corner(wall.mesh, triangle[0]), b = corner(wall.mesh, triangle[1]), c = corner(wall.mesh, triangle[2]);
    return (b - a).cross(c - a).dot(point - a) > 0;
  });
}

double area(const WallPicture& wall) {
  double sum = 0;
  for (const auto& [i, j, k] : wall.mesh.triangles) {
    const Vector3d a = corner(wall.mesh, i);
    sum += (corner(wall.mesh, j) - a).cross(corner(wall.mesh, k) - a).norm() / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("parts of a box: a floor and four walls up to where the grains start") {
  const std::vector<WallPicture> pictures = pictures_of(Box{{0.2, 0.3}}, 0.5);
  const WallPicture& floor = find(pictures, "floor");
  const WallPicture& walls = find(pictures, "walls");
  const Vector3d inside(0.1, 0.1, 0.2);
  CHECK(looks_at(floor, inside));
  CHECK(looks_at(walls, inside));
  CHECK(area(floor) == doctest::Approx(0.06));
  CHECK(area(walls) == doctest::Approx(2 * (0.2 + 0.3) * 0.5));
}

TEST_CASE("parts of a hopper: mesh, lid over the outlet, tray, dish") {
  Hopper hopper{0.02, 30, 0.1, 0.05, 16, 0.06, 0.2, 1};
  hopper.dish = Dish{0.05, 0.01, 0.002};
  const std::vector<WallPicture> pictures = pictures_of(hopper, 1);
  CHECK(looks_at(find(pictures, "hopper"), {0, 0, 0.1}));
  CHECK(looks_at(find(pictures, "walls"), {0.05, 0.05, 0.03}));
  CHECK(find(pictures, "dish").mesh.triangles.size() == 7 * 16);
  const WallPicture& lid = find(pictures, "lid");
  CHECK(lid.role == WallPicture::Role::Lid);
  CHECK(looks_at(lid, {0, 0, 0.1}));
  CHECK(area(lid) == doctest::Approx(16 * 0.01 * 0.01 * std::tan(std::numbers::pi / 16)));  // around the inscribed circle
  for (const WallPicture& wall : pictures) {
    for (const auto& edge : wall.edges) CHECK(std::max(edge[0], edge[1]) < wall.mesh.vertices.size());
  }
}

TEST_CASE("parts of a terrain: the ground has the heights of the terrain") {
  const Terrain terrain({{0.2, 0.1}, 0.01, 0.08, 0.005, 41, 7});
  const std::vector<WallPicture> pictures = pictures_of(terrain, 0.3);
  const WallPicture& ground = find(pictures, "ground");
  CHECK(looks_at(ground, {0.1, 0.05, 10}));
  for (const auto& [i, j, k] : ground.mesh.triangles) {
    const Vector3d middle = (corner(ground.mesh, i) + corner(ground.mesh, j) + corner(ground.mesh, k)) / 3;
    CHECK(middle.z() == doctest::Approx(terrain.height(middle.x(), middle.y())).epsilon(1e-5));
  }
  CHECK(looks_at(find(pictures, "walls"), {0.1, 0.05, 0.1}));
}

TEST_CASE("parts of a periodic container: the twelve edges of a cube of side 1") {
  const std::vector<WallPicture> pictures = pictures_of(Periodic{0.3}, 1);
  REQUIRE(pictures.size() == 1);
  CHECK(pictures[0].role == WallPicture::Role::Cell);
  std::set<std::array<unsigned int, 2>> edges;
  for (const auto& [a, b] : pictures[0].edges) {
    CHECK((corner(pictures[0].mesh, a) - corner(pictures[0].mesh, b)).norm() == doctest::Approx(1));
    edges.insert(std::minmax({a, b}) == std::pair{a, b} ? std::array{a, b} : std::array{b, a});
  }
  CHECK(edges.size() == 12);
}
