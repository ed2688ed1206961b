// A plane whose vertices are floats acts as a plane, and a real crease as a crease.
#include <doctest/doctest.h>

#include <functional>

#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"
#include "support/ode_world.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr int kCells = 40;

/// Triangles over a square about a place, with the height at each vertex.
MeshArrays sheet(const Vec& middle, double cell, const std::function<double(double x, double y)>& height) {
  MeshArrays mesh = floor_arrays(kCells, kCells, 1);
  for (auto& vertex : mesh.vertices) {
    const double x = middle[0] + cell * (double{vertex[0]} - 0.5 * kCells);
    const double y = middle[1] + cell * (double{vertex[1]} - 0.5 * kCells);
    vertex = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(height(x, y))};
  }
  return mesh;
}

/// How far a vertex at this distance from the origin of its mesh may be rounded, m.
double rounding_at(double distance) { return 0.5 * std::numeric_limits<float>::epsilon() * distance; }

/// Checks bodies of 0.1 m on a floor of cells within a slope: the contacts have the number, the normals and the depth of those with
/// the plane.
void check_is_plane(dGeomID floor, dGeomID plane, const Vec& middle, double cell, double rounding) {
  dVector4 level;
  dGeomPlaneGetParams(plane, level);
  const Vec up = to_vec(level);
  Random random(5);
  World world;
  for (int i = 0; i < 12; ++i) {
    CAPTURE(i);
    const dReal exponent = i % 3 == 0 ? 2 : 20;
    const Geom geom(snCreateSuperellipsoid(nullptr, dReal(0.1), dReal(0.07), dReal(0.05), exponent, exponent));
    const dBodyID body = world.add(geom, 1000);
    dMatrix3 turn;
    dRFromZAxis(turn, dReal(up[0]), dReal(up[1]), dReal(up[2]));
    dBodySetRotation(body, turn);
    if (i % 3 != 1) random.turn(geom);
    place(geom, middle + 0.2 * random.direction() + up);
    for (int k = 0; k < 2; ++k) {
      snProximity now;
      snGeomProximity(geom, plane, &now);
      const double depth = k == 0 ? 0 : std::max(random.log_uniform(1e-5, 1e-3), 8 * rounding);
      move(geom, -(now.gap + depth) * up);
    }
    dBodySetLinearVel(body, 1, 0, dReal(-up[0] / up[2] - 0.05));
    for (const double time : {0.0, 0.005}) {
      CAPTURE(time);
      snGeomSetLookAhead(geom, dReal(time));
      const auto found = collide(geom, floor), wanted = collide(geom, plane);
      REQUIRE(found.size() == wanted.size());
      REQUIRE(!found.empty());
      CHECK(std::abs(double{found[0].depth} - double{wanted[0].depth}) < 2 * rounding);
      for (const dContactGeom& contact : found) CHECK(norm(to_vec(contact.normal) - up) < 4 * rounding / std::max(cell, 0.1));
    }
  }
}

}  // namespace

TEST_CASE("a slope of rounded vertices has the contacts of a plane" * doctest::skip(kIsSinglePrecision)) {
  OdeSession session;
  for (const double slope : {0.05, 1.0}) {
    for (const double away : {0.0, 1000.0}) {
      for (const double cell : {0.02, 1.0}) {
        CAPTURE(slope);
        CAPTURE(away);
        CAPTURE(cell);
        const auto height = [slope](double x, double y) { return slope * (x + 0.3 * y); };
        const Geom plane(dCreatePlane(nullptr, dReal(-slope), dReal(-0.3 * slope), 1, 0));
        const Vec middle = {away, away, height(away, away)};
        const double half = 0.5 * kCells * cell;
        const double rounding = rounding_at(norm(middle) + 2 * half);
        check_is_plane(MeshGeom(sheet(middle, cell, height)), plane, middle, cell, rounding);
        // The x of a heightfield is the world's, its y is up, its z is -y of the world. `away` raises it here.
        const Terrain terrain(
            {.columns = kCells + 1, .rows = kCells + 1, .width = 2 * half, .depth = 2 * half, .source = Source::Single},
            [&](int i, int j) { return height(away + i * cell - half, half - j * cell); });
        const Geom field(terrain.create(true));
        dMatrix3 turn;
        dRFromAxisAndAngle(turn, 1, 0, 0, dReal(0.5 * 3.14159265358979323846));
        dGeomSetRotation(field, turn);
        place(field, {away, 0, 0});
        check_is_plane(field, plane, {away, 0, slope * away}, cell, rounding);
      }
    }
  }
}

TEST_CASE("two slopes of rounded vertices that meet at 1e-3 rad are no plane") {
  OdeSession session;
  const Vec up = (1 / std::sqrt(1.09)) * Vec{0, -0.3, 1}, middle = {10, 10, 3};
  const MeshGeom valley(sheet(middle, 0.1, [](double x, double y) { return 0.3 * y + 5e-4 * std::abs(x - 10); }));
  const Geom ball(snCreateEllipsoid(nullptr, 10, 10, 10));
  place(ball, middle + (10 - 1e-3) * up);
  CHECK(collide(ball, valley).size() == 2);
}
