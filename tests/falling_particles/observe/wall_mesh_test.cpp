// Tests of what pictures show of parts: closed surfaces of the right size, seen from outside.
#include "observe/wall_mesh.hpp"

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "model/container.hpp"

using namespace falling_particles;

namespace {

Vector3 vertex_at(const Mesh& mesh, unsigned int index) {
  return {mesh.vertices[index][0], mesh.vertices[index][1], mesh.vertices[index][2]};
}

/// m^3, by the divergence theorem: positive where the triangles look outwards.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += vertex_at(mesh, a).dot(vertex_at(mesh, b).cross(vertex_at(mesh, c))) / 6;
  return sum;
}

/// Whether every edge belongs to two triangles, which run along it in opposite directions.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<unsigned int, unsigned int>, int> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) ++edges[{from, to}];
  }
  for (const auto& [edge, count] : edges) {
    if (count != 1 || !edges.contains({edge.second, edge.first})) return false;
  }
  return true;
}

/// m
Box3 cube(double side, const Vector3& centre = Vector3::Zero()) {
  const Vector3 half = Vector3::Constant(side / 2);
  return {centre - half, centre + half};
}

const WallPicture& find(const std::vector<WallPicture>& pictures, const std::string& name) {
  const auto found = std::ranges::find(pictures, name, &WallPicture::name);
  REQUIRE(found != pictures.end());
  return *found;
}

/// Whether all triangles of the part look at the point.
bool looks_at(const WallPicture& wall, const Vector3& point) {
  return std::ranges::all_of(wall.mesh.triangles, [&](const auto& triangle) {
    const Vector3 a = vertex_at(wall.mesh, triangle[0]), b = vertex_at(wall.mesh, triangle[1]),
                  c = vertex_at(wall.mesh, triangle[2]);
    return (b - a).cross(c - a).dot(point - a) > 0;
  });
}

double area(const WallPicture& wall) {
  double sum = 0;
  for (const auto& [i, j, k] : wall.mesh.triangles) {
    const Vector3 a = vertex_at(wall.mesh, i);
    sum += (vertex_at(wall.mesh, j) - a).cross(vertex_at(wall.mesh, k) - a).norm() / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("pictures of parts are closed, look outwards, and have the parts' volumes") {
  constexpr double kPi = std::numbers::pi;
  const std::vector<std::tuple<WallShape, double, std::size_t>> shapes = {
      {BoxShape{{0.1, 0.2, 0.3}}, 0.006, 12},
      {CylinderShape{0.1, 0.5}, kPi * 0.01 * 0.5, 128},
      {SmoothShape{{0.1, 0.2, 0.3}, 2, 2, 0, 0}, 4.0 / 3 * kPi * 0.006, 0},
  };
  for (const auto& [shape, wanted, edges] : shapes) {
    Wall wall{"part", shape};
    wall.motions = {{Translation{{1, 0, 0}}}};
    const WallPicture picture = picture_of(wall, cube(1));
    CHECK(picture.role == WallPicture::Role::Moving);
    CHECK(is_closed(picture.mesh));
    CHECK(volume(picture.mesh) == doctest::Approx(wanted).epsilon(0.02));
    CHECK(picture.edges.size() == edges);
  }
}

TEST_CASE("the picture of a plane looks along the plane's own normal") {
  const WallPicture picture = picture_of({"wall", PlaneShape{0, -Vector3::UnitY()}, {{0, 1, 0}}}, cube(0.4));
  const auto& [a, b, c] = picture.mesh.triangles.at(0);
  const Vector3 p = vertex_at(picture.mesh, a);
  CHECK(((vertex_at(picture.mesh, b) - p).cross(vertex_at(picture.mesh, c) - p).normalized() + Vector3::UnitY()).norm() < 1e-6);
  for (const auto& vertex : picture.mesh.vertices) CHECK(vertex[1] == doctest::Approx(1));
}

TEST_CASE("the picture of a part that stands is where it stands, and that of a plane looks along its normal") {
  Wall wall{"wall", PlaneShape{}, {{0, 0, 2}, Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitY()))}};
  const WallPicture picture = picture_of(wall, cube(0.4, {0, 0, 2}));
  CHECK(picture.role == WallPicture::Role::Still);
  REQUIRE(picture.mesh.triangles.size() == 2);
  const auto& [a, b, c] = picture.mesh.triangles[0];
  const Vector3 p = vertex_at(picture.mesh, a);
  const Vector3 normal = (vertex_at(picture.mesh, b) - p).cross(vertex_at(picture.mesh, c) - p).normalized();
  CHECK((normal - Vector3::UnitX()).norm() < 1e-6);
  for (const auto& vertex : picture.mesh.vertices) {
    CHECK(std::abs(vertex[0]) < 1e-7F);
    CHECK(std::abs(vertex[2] - 2) == doctest::Approx(0.2).epsilon(1e-6));
  }
}

TEST_CASE("planes are drawn below the contents of the scene: the faces of a cell, and a floor as wide again") {
  const Box3 contents(Vector3(1, 2, 3), Vector3(1.2, 2.4, 3.8));
  const auto plane = [](const Vector3& normal, const Vector3& position) {
    return Wall{"plane", PlaneShape{0, normal}, {position, Eigen::Quaterniond::Identity()}};
  };
  const std::vector<Wall> cell = {plane(Vector3::UnitX(), {0.95, 0, 0}), plane(-Vector3::UnitX(), {1.25, 7, 0}),
                                  plane(Vector3::UnitY(), {0, 1.9, 0}),  plane(-Vector3::UnitY(), {0, 2.5, -3}),
                                  plane(Vector3::UnitZ(), {5, 5, 2.9}),  plane(-Vector3::UnitZ(), {0, 0, 3.9})};
  const Box3 room(Vector3(0.95, 1.9, 2.9), Vector3(1.25, 2.5, 3.9));
  CHECK(region_of_planes(contents, cell).isApprox(room));
  const auto box_of = [](const WallPicture& picture) {
    Box3 box;
    for (unsigned int i = 0; i < picture.mesh.vertices.size(); ++i) box.extend(vertex_at(picture.mesh, i));
    return box;
  };
  Box3 drawn;
  for (const Wall& wall : cell) {
    const Box3 face = box_of(picture_of(wall, room));
    CHECK(face.sizes().minCoeff() < 1e-6);
    drawn.extend(face);
  }
  CHECK(drawn.isApprox(room, 1e-6));
  const std::vector<Wall> floor = {plane(Vector3::UnitZ(), {50, -70, 2.9}), plane(Vector3(0, 0.6, 0.8), {0, 0, 2})};
  const Box3 wide = region_of_planes(contents, floor);
  CHECK(wide.isApprox(Box3(Vector3(0.9, 1.8, 2.9), Vector3(1.3, 2.6, 4.2))));
  CHECK(box_of(picture_of(floor[0], wide)).isApprox(Box3(Vector3(0.9, 1.8, 2.9), Vector3(1.3, 2.6, 2.9)), 1e-6));
}

TEST_CASE("the picture of a ground has its samples around its position, and looks upwards") {
  const Wall ground{"ground", GroundShape{3, {0.1, 0.2}, {0, 0, 0.5, 0, 1, 0, 0, 0, 0}}, {{1, 2, 3}}};
  const WallPicture picture = picture_of(ground, cube(1));
  REQUIRE(picture.mesh.vertices.size() == 9);
  REQUIRE(picture.mesh.triangles.size() == 8);
  CHECK((vertex_at(picture.mesh, 0) - Vector3(0.9, 1.8, 3)).norm() < 1e-6);
  CHECK((vertex_at(picture.mesh, 2) - Vector3(1.1, 1.8, 3.5)).norm() < 1e-6);
  CHECK((vertex_at(picture.mesh, 4) - Vector3(1, 2, 4)).norm() < 1e-6);
  for (const auto& [a, b, c] : picture.mesh.triangles) {
    const Vector3 p = vertex_at(picture.mesh, a);
    CHECK((vertex_at(picture.mesh, b) - p).cross(vertex_at(picture.mesh, c) - p).z() > 0);
  }
}

TEST_CASE("the ends of a drum are shown as discs as wide as the drum") {
  const Drum drum{.diameter = 0.2, .length = 0.1, .segments = 24, .rpm = 10, .turns_at = 0};
  const std::vector<Wall> walls = walls_in(drum);
  for (const std::size_t end : {1U, 2U}) {
    const WallPicture picture = picture_of(walls[end], cube(0.7));
    double radius = 0;
    for (const auto& [x, y, z] : picture.mesh.vertices) radius = std::max(radius, Vector3(x, y, z).norm());
    CHECK(radius == doctest::Approx(drum.outer_radius()).epsilon(1e-6));
  }
}

TEST_CASE("parts of a box: a floor and four walls up to where the grains start") {
  const std::vector<WallPicture> pictures = pictures_of(Box{{0.2, 0.3}}, 0.5);
  const WallPicture& floor = find(pictures, "floor");
  const WallPicture& walls = find(pictures, "walls");
  const Vector3 inside(0.1, 0.1, 0.2);
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
    const Vector3 middle = (vertex_at(ground.mesh, i) + vertex_at(ground.mesh, j) + vertex_at(ground.mesh, k)) / 3;
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
    CHECK((vertex_at(pictures[0].mesh, a) - vertex_at(pictures[0].mesh, b)).norm() == doctest::Approx(1));
    edges.insert(std::minmax({a, b}) == std::pair{a, b} ? std::array{a, b} : std::array{b, a});
  }
  CHECK(edges.size() == 12);
}
