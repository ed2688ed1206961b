// Floors with unconnected vertices act as a plane: tiles of one geom each, T-junctions, brick bonds and vertices with rounding
// errors.
#include <doctest/doctest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"
#include "support/ode_world.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

/// A floor and its frame: `up` is its normal.
struct SeamedFloor {
  std::vector<std::unique_ptr<MeshGeom>> tiles = {};
  std::vector<std::unique_ptr<Terrain>> terrains = {};
  std::vector<Geom> fields = {};
  Vec origin{0, 0, 0};
  Vec along{1, 0, 0};
  Vec across{0, 1, 0};
  Vec up{0, 0, 1};
  double rounding = 0;  ///< m; the largest distance of a vertex from the plane

  std::vector<dGeomID> geoms() const {
    std::vector<dGeomID> all(fields.begin(), fields.end());
    for (const std::unique_ptr<MeshGeom>& tile : tiles) all.push_back(*tile);
    return all;
  }
  Vec at(double x, double y, double z) const { return origin + x * along + y * across + z * up; }
};

void tilt(SeamedFloor& floor) {
  dMatrix3 turn;
  dRFromAxisAndAngle(turn, 1, 2, dReal(0.5), dReal(0.4));
  floor.along = {turn[0], turn[4], turn[8]};
  floor.across = {turn[1], turn[5], turn[9]};
  floor.up = {turn[2], turn[6], turn[10]};
}

/// Adds two triangles with their own vertices, each moved at random by up to `apart` (m).
void add_rectangle(TriangleMesh& mesh, const SeamedFloor& floor, double x0, double x1, double y0, double y1, double apart,
                   Random& random) {
  const auto vertex = [&](double x, double y) {
    const Vec v = floor.at(x, y, 0) + random.uniform(0, apart) * random.direction();
    return mesh.add({v[0], v[1], v[2]});
  };
  for (const bool is_first : {true, false}) {
    const int a = vertex(x0, y0);
    const int b = is_first ? vertex(x1, y0) : vertex(x1, y1);
    const int c = is_first ? vertex(x1, y1) : vertex(x0, y1);
    mesh.triangles.push_back({a, b, c});
  }
}

enum class Laying { Tiles, TJunctions, BrickBond, Unwelded };

SeamedFloor lay(Laying laying, bool is_tilted, double apart = 0, double far = 0) {
  SeamedFloor floor;
  if (is_tilted) tilt(floor);
  floor.origin = far * floor.along + far * floor.across;
  floor.rounding = apart + 4e-7 * (1 + 2 * far);  // the rounding of floats
  Random random(41);
  TriangleMesh one;
  for (int i = -2; i < 2; ++i) {
    const int parts = laying == Laying::TJunctions && i >= 0 ? 3 : 4;
    const double shift = laying == Laying::BrickBond && i % 2 != 0 ? 0.25 : 0;
    for (int j = 0; j < parts; ++j) {
      const auto add_to = [&](TriangleMesh& mesh) {
        add_rectangle(mesh, floor, 0.5 * i, 0.5 * i + 0.5, -1 + 2.0 * j / parts + shift, -1 + 2.0 * (j + 1) / parts + shift, apart,
                      random);
      };
      if (laying != Laying::Tiles) {
        add_to(one);
        continue;
      }
      TriangleMesh tile;
      add_to(tile);
      floor.tiles.push_back(std::make_unique<MeshGeom>(std::move(tile)));
    }
  }
  if (laying != Laying::Tiles) floor.tiles.push_back(std::make_unique<MeshGeom>(std::move(one)));
  return floor;
}

/// Four level heightfields side by side, with the y axis up.
SeamedFloor lay_heightfields() {
  SeamedFloor floor{.along = {0, 0, 1}, .across = {1, 0, 0}, .up = {0, 1, 0}, .rounding = 1e-11};
  for (const double x : {-0.5, 0.5}) {
    for (const double z : {-0.5, 0.5}) {
      floor.terrains.push_back(std::make_unique<Terrain>(Terrain::Layout{3, 3, 1, 1}, [](int, int) { return 0.0; }));
      floor.fields.emplace_back(floor.terrains.back()->create(true));
      place(floor.fields.back(), {x, 0, z});
    }
  }
  return floor;
}

struct Row {
  std::string name;
  std::function<SeamedFloor()> lay;
};

std::vector<Row> rows() {
  return {{"tiles", [] { return lay(Laying::Tiles, false); }},
          {"tiles, sloping", [] { return lay(Laying::Tiles, true); }},
          {"tiles, sloping, far from their origin", [] { return lay(Laying::Tiles, true, 0, 10); }},
          {"T-junctions", [] { return lay(Laying::TJunctions, false); }},
          {"T-junctions, sloping", [] { return lay(Laying::TJunctions, true); }},
          {"T-junctions, sloping, far from their origin", [] { return lay(Laying::TJunctions, true, 0, 10); }},
          {"brick bond, sloping", [] { return lay(Laying::BrickBond, true); }},
          {"brick bond, sloping, far from its origin", [] { return lay(Laying::BrickBond, true, 0, 10); }},
          {"vertices 1e-7 apart", [] { return lay(Laying::Unwelded, false, 1e-7 / 2 * 0.7); }},
          {"vertices 1e-6 apart", [] { return lay(Laying::Unwelded, false, 1e-6 / 2 * 0.7); }},
          {"vertices 1e-6 apart, sloping", [] { return lay(Laying::Unwelded, true, 1e-6 / 2 * 0.7); }},
          {"heightfields", lay_heightfields}};
}

enum class Faller { Ball, Ellipsoid, Brick, Can };

dGeomID make_body(Faller kind) {
  if (kind == Faller::Ball) return snCreateEllipsoid(nullptr, dReal(0.1), dReal(0.1), dReal(0.1));
  if (kind == Faller::Ellipsoid) return snCreateEllipsoid(nullptr, dReal(0.13), dReal(0.09), dReal(0.06));
  if (kind == Faller::Brick) return snCreateSuperellipsoid(nullptr, dReal(0.12), dReal(0.1), dReal(0.05), 60, 60);
  return snCreateSuperellipsoid(nullptr, dReal(0.07), dReal(0.07), dReal(0.1), 2, 60);
}

double height_of(Faller kind) {
  if (kind == Faller::Brick) return 0.05;
  return kind == Faller::Ellipsoid ? 0.06 : 0.1;
}

/// Rotates the body so that its z axis is the floor's normal.
void stand_on(const SeamedFloor& floor, dGeomID geom) {
  dMatrix3 turn{};
  for (std::size_t k = 0; k < 3; ++k) {
    turn[4 * k] = dReal(floor.along[k]);
    turn[4 * k + 1] = dReal(floor.across[k]);
    turn[4 * k + 2] = dReal(floor.up[k]);
  }
  dGeomSetRotation(geom, turn);
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "a body anywhere on a floor with seams has the normal and the depth of the plane" *
                                  doctest::skip(kIsSinglePrecision)) {
  for (const Row& row : rows()) {
    CAPTURE(row.name);
    const SeamedFloor floor = row.lay();
    for (const Faller kind : {Faller::Ball, Faller::Ellipsoid, Faller::Brick, Faller::Can}) {
      CAPTURE(static_cast<int>(kind));
      const Geom body(make_body(kind));
      stand_on(floor, body);
      for (const double relative_depth : {1e-4, 1e-3, 1e-2, 5e-2}) {
        CAPTURE(relative_depth);
        Random random(42);
        const double depth = relative_depth * height_of(kind);
        double worst_tilt = 0;
        double worst_depth = 0;
        for (int k = 0; k < 1000; ++k) {
          // Half of them are so near to a seam that they may be over the next tile.
          const double near = k % 2 == 0 ? 0 : random.uniform(-0.03, 0.03) * random.uniform(0, 1) * random.uniform(0, 1);
          const double x = k % 2 == 0 ? random.uniform(-0.8, 0.8) : near;
          const double y = k % 4 == 1 ? near : random.uniform(-0.7, 0.7);
          place(body, floor.at(x, y, height_of(kind) - depth));
          double deepest = 0;
          for (const dGeomID geom : floor.geoms()) {
            for (const dContactGeom& contact : collide(body, geom)) {
              const double up = dot(floor.up, to_vec(contact.normal));
              worst_tilt = std::max(worst_tilt, norm(to_vec(contact.normal) - up * floor.up));
              if (up < 0) worst_tilt = 1;
              deepest = std::max(deepest, double{contact.depth});
            }
          }
          worst_depth = std::max(worst_depth, std::abs(deepest - depth));
        }
        CHECK(worst_tilt < 10 * floor.rounding);
        CHECK(worst_depth < 4 * floor.rounding);
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "a body slides over seams as it slides over a plane" * doctest::skip(kIsSinglePrecision)) {
  for (const Row& row : rows()) {
    CAPTURE(row.name);
    const SeamedFloor floor = row.lay();
    for (const Faller kind : {Faller::Ball, Faller::Ellipsoid, Faller::Brick, Faller::Can}) {
      CAPTURE(static_cast<int>(kind));
      const Vec velocity = 1.3 * floor.along + 1.1 * floor.across;
      World world;
      set_gravity(world, -kGravity * floor.up);
      const Geom geom(make_body(kind));
      const dBodyID body = world.add(geom, 1000);
      stand_on(floor, geom);
      place(geom, floor.at(-0.7, -0.61, height_of(kind)));
      dBodySetLinearVel(body, dReal(velocity[0]), dReal(velocity[1]), dReal(velocity[2]));
      const std::vector<dGeomID> parts = floor.geoms();
      double worst = 0;
      double sunk = 0;
      for (int step = 0; step < 500; ++step) {
        world.quick_step_of(geom, parts, 2e-3);
        const Vec change = to_vec(dBodyGetLinearVel(body)) - velocity;
        worst = std::max(worst, norm(change - dot(change, floor.up) * floor.up));
        sunk = std::max(sunk, height_of(kind) - dot(floor.up, to_vec(dBodyGetPosition(body)) - floor.origin));
      }
      CHECK(worst < 1e-3);
      CHECK(sunk < 0.01 * height_of(kind));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession,
                  "an overhanging body stays on the border of a sheet, and falls when its middle is beyond the border") {
  for (const double beyond : {-0.02, 0.02}) {
    for (const Faller kind : {Faller::Ball, Faller::Brick, Faller::Can}) {
      CAPTURE(beyond);
      CAPTURE(static_cast<int>(kind));
      World world;
      world.surface.mu = dReal(0.5);
      MeshGeom table(sheet_mesh(2, 2, 0.5), world.space());
      const dGeomID geom = make_body(kind);
      dSpaceAdd(world.space(), geom);
      const dBodyID body = world.add(geom, 1000);
      place(geom, {1 + beyond, 0.5, height_of(kind)});
      for (int step = 0; step < 2000; ++step) world.quick_step(1e-3);
      const double height{dBodyGetPosition(body)[2]};
      if (beyond < 0) CHECK(height > 0.98 * height_of(kind));
      if (beyond > 0) CHECK(height < -height_of(kind));
      dSpaceRemove(world.space(), table);
    }
  }
}
