// Tests that flat bodies rest as well as ODE's own boxes: on a plane, on a box, on a mesh and on each other.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "ode/mesh_fixture.hpp"
#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

constexpr double kStep = 0.002;    // s
constexpr double kDensity = 1000;  // kg/m^3
constexpr int kSteps = 5000;       // 10 s
constexpr int kHalfTime = kSteps / 2;
constexpr std::array<double, 3> kHalfAxes = {0.1, 0.07, 0.05};

/// The form of a brick: ODE's box, or a body of ours with an exponent.
struct Brick {
  double exponent = 0;  // 0: dBox

  dGeomID create(dSpaceID space, dMass& mass) const {
    const auto [a, b, c] = kHalfAxes;
    if (exponent == 0) {
      dMassSetBox(&mass, dReal(kDensity), dReal(2 * a), dReal(2 * b), dReal(2 * c));
      return dCreateBox(space, dReal(2 * a), dReal(2 * b), dReal(2 * c));
    }
    dGeomID geom = snCreateSuperellipsoid(space, dReal(a), dReal(b), dReal(c), dReal(exponent), dReal(exponent));
    REQUIRE(snMassSet(&mass, dReal(kDensity), geom) == 1);
    return geom;
  }
};

enum class Floor { Plane, Box, Mesh };

/// A world with ODE's defaults except for dContactApprox1 and mu = 0.5; eight contacts a pair.
class RestingScene {
 public:
  explicit RestingScene(Floor floor) {
    world_.set_friction(0.5);
    if (floor == Floor::Plane) {
      world_.add_plane();
    } else if (floor == Floor::Box) {
      dGeomSetPosition(dCreateBox(world_.space(), 4, 4, 1), 0, 0, dReal(-0.5));
    } else {
      mesh_.emplace(TriangleMesh{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}}, world_.space());
    }
  }

  void auto_disable() const { dWorldSetAutoDisableFlag(world_.id(), 1); }

  void add(const Brick& brick, const Vec& position, const Vec& axis, double angle) {
    dMass mass;
    const dGeomID geom = brick.create(world_.space(), mass);
    const dBodyID body = world_.add(geom, mass);
    dBodySetPosition(body, dReal(position[0]), dReal(position[1]), dReal(position[2]));
    turn(body, axis, angle);
    bodies_.push_back(body);
  }

  void step(double duration = kStep) {
    dRandSetSeed(static_cast<unsigned long>(++steps_));
    world_.quick_step(dReal(duration));
  }

  bool is_asleep() const {
    return std::none_of(bodies_.begin(), bodies_.end(), [](dBodyID body) { return dBodyIsEnabled(body) != 0; });
  }

  double kinetic_energy() const {
    double sum = 0;
    for (dBodyID body : bodies_) sum += supernormal::test::kinetic_energy(body);
    return sum;
  }

  std::vector<Vec> positions() const {
    std::vector<Vec> all;
    for (dBodyID body : bodies_) all.push_back(to_vec(dBodyGetPosition(body)));
    return all;
  }

 private:
  World world_{dSimpleSpaceCreate(nullptr)};
  std::optional<MeshGeom> mesh_;
  std::vector<dBodyID> bodies_;
  int steps_ = 0;
};

struct Tilt {
  Vec axis;
  double angle;
};

/// Number 0 is tilted by 0.05 rad about (1, 0.3, 0). The others have axes all around and tilts from 1 to 6.5 degrees.
Tilt tilt_of_drop(int k) {
  if (k == 0) return {{1, 0.3, 0}, 0.05};
  return {{std::cos(2.4 * k), std::sin(2.4 * k), 0}, 0.02 + 0.004 * k};
}

/// The time (s) in which a brick that is dropped from 0.15 m falls asleep. If it does not, the end of the run.
double time_to_sleep(const Brick& brick, Floor floor, const Tilt& tilt) {
  RestingScene scene(floor);
  scene.auto_disable();
  scene.add(brick, {0, 0, 0.15}, tilt.axis, tilt.angle);
  int step = 0;
  while (step < kSteps && !scene.is_asleep()) {
    scene.step();
    ++step;
  }
  return kStep * step;
}

struct Times {
  double first;    // s; of drop 0
  double median;   // s
  double longest;  // s
};

Times times_to_sleep(const Brick& brick, Floor floor) {
  std::array<double, 24> times{};
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = time_to_sleep(brick, floor, tilt_of_drop(static_cast<int>(k)));
  const double first = times[0];
  std::sort(times.begin(), times.end());
  return {first, times[times.size() / 2], times.back()};
}

/// The motion that remains from 5 s to 10 s, without auto-disable.
struct Residue {
  double energy = 0;  // mean kinetic energy, J
  double drift = 0;   // m; of the body that moves most
};

Residue residue(RestingScene& scene) {
  Residue result;
  for (int step = 0; step < kHalfTime; ++step) scene.step();
  const std::vector<Vec> before = scene.positions();
  for (int step = kHalfTime; step < kSteps; ++step) {
    scene.step();
    result.energy += scene.kinetic_energy() / (kSteps - kHalfTime);
  }
  const std::vector<Vec> after = scene.positions();
  for (std::size_t k = 0; k < after.size(); ++k) result.drift = std::max(result.drift, norm(after[k] - before[k]));
  return result;
}

void add_stack(const Brick& brick, double offset, RestingScene& scene) {
  for (int k = 0; k < 5; ++k) scene.add(brick, {0.005 * (k % 2) + offset, 0, 0.06 + 0.11 * k}, {1, 0.3, 0}, 0.01 * (k % 3 - 1));
}

Residue residue_of_stack(const Brick& brick) {
  RestingScene scene(Floor::Plane);
  add_stack(brick, 0, scene);
  return residue(scene);
}

/// A body of radius 1/20 m that stands on a much smaller line or face.
struct Stubby {
  std::string name;
  dGeomID (*create)(dSpaceID space, dReal radius);
  bool is_lying;  // its z axis is horizontal, not vertical
};

dGeomID create_stubby_capsule(dSpaceID space, dReal radius) { return snCreateCapsule(space, radius, radius / 5); }
dGeomID create_short_capsule(dSpaceID space, dReal radius) { return snCreateCapsule(space, radius, 3 * radius / 5); }
dGeomID create_rounded_disc(dSpaceID space, dReal radius) {
  const dReal half_axis = radius / 6;
  const dGeomID geom = snCreateSuperellipsoid(space, half_axis, half_axis, half_axis, 2, 60);
  REQUIRE(snGeomSetRounding(geom, 5 * half_axis) == 1);
  return geom;
}

/// The tilt (rad) of a body that was dropped with a tilt and has fallen asleep.
double lean_asleep(const Stubby& what, const Tilt& tilt) {
  World world{dSimpleSpaceCreate(nullptr)};
  world.set_friction(0.5);
  world.add_plane();
  dWorldSetAutoDisableFlag(world.id(), 1);
  const auto radius = dReal(0.05);
  const dBodyID body = world.add(what.create(world.space(), radius), kDensity);
  dQuaternion aslant;
  dQuaternion lying;
  dQuaternion both;
  dQFromAxisAndAngle(aslant, dReal(tilt.axis[0]), dReal(tilt.axis[1]), dReal(tilt.axis[2]), dReal(tilt.angle));
  dQFromAxisAndAngle(lying, 0, 1, 0, what.is_lying ? dReal(std::numbers::pi / 2) : 0);
  dQMultiply0(both, aslant, lying);
  dBodySetQuaternion(body, both);
  dBodySetPosition(body, 0, 0, dReal(1.3) * radius);
  for (int step = 0; step < kSteps && dBodyIsEnabled(body) != 0; ++step) world.quick_step(kStep);
  CHECK(dBodyIsEnabled(body) == 0);
  const double upwards = std::min(1.0, std::abs(double{dBodyGetRotation(body)[10]}));
  return what.is_lying ? std::asin(upwards) : std::acos(upwards);
}

constexpr std::array<double, 4> kExponents = {8, 12, 20, 60};

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "a flat body falls asleep within twice the time of a dBox") {
  for (const Floor floor : {Floor::Plane, Floor::Box, Floor::Mesh}) {
    const Times box = times_to_sleep({}, floor);
    MESSAGE("floor ", static_cast<int>(floor), ", dBox: ", box.first, " s; median ", box.median, " s, longest ", box.longest, " s");
    for (const double exponent : kExponents) {
      const Times ours = times_to_sleep({exponent}, floor);
      MESSAGE("exponent ", exponent, ": ", ours.first, " s; median ", ours.median, " s, longest ", ours.longest, " s");
      // The time of one drop is random: it depends on how the first corner hits.
      CHECK(ours.median <= 2 * box.median);
      CHECK(ours.longest <= 3 * box.longest);
      if (floor == Floor::Plane) CHECK(ours.first <= 2 * box.first);
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "a body that stands on a small face or a short line falls asleep no more tilted than others") {
  for (const Stubby& what : {Stubby{"capsule, half-length 0.1 radii", create_stubby_capsule, true},
                             Stubby{"capsule, half-length 0.3 radii", create_short_capsule, true},
                             Stubby{"disc, 5/6 rounded", create_rounded_disc, false}}) {
    double largest = 0;
    for (int k = 0; k < 24; ++k) largest = std::max(largest, lean_asleep(what, tilt_of_drop(k)));
    MESSAGE(what.name, ": leans by up to ", largest, " rad");
    CHECK(largest <= 0.005);
  }
}

TEST_CASE_FIXTURE(OdeSession, "a stack of five is as still as five dBoxes") {
  const Residue boxes = residue_of_stack({});
  MESSAGE("dBox: ", 1e6 * boxes.energy, " uJ, ", 1e3 * boxes.drift, " mm");
  for (const double exponent : kExponents) {
    const Residue ours = residue_of_stack({exponent});
    MESSAGE("exponent ", exponent, ": ", 1e6 * ours.energy, " uJ, ", 1e3 * ours.drift, " mm");
    CAPTURE(exponent);
    CHECK(ours.energy <= 10 * boxes.energy);
    CHECK(ours.drift <= std::max(3 * boxes.drift, 0.002));
  }
}

TEST_CASE_FIXTURE(OdeSession, "a stack of five stands for ten seconds at steps of 10 to 20 ms") {
  for (const double step : {0.01, 0.0167, 0.02}) {
    for (const double exponent : {0.0, 12.0, 20.0, 60.0}) {  // 0: dBox
      for (int repetition = 0; repetition < 6; ++repetition) {
        CAPTURE(step);
        CAPTURE(exponent);
        RestingScene scene(Floor::Plane);
        add_stack({exponent}, 1e-5 * repetition, scene);
        const int steps = static_cast<int>(10 / step);
        for (int k = 0; k < steps; ++k) scene.step(step);
        const std::vector<Vec> positions = scene.positions();
        // At rest the highest body is 0.45 above the floor.
        CHECK(positions.back()[2] >= 0.43);
      }
    }
  }
}

namespace {

/// The lowest point of a can, m, six seconds after it fell onto the plane z = 0 from 0.4 radii, lying but for 0.03 rad.
double lowest_point_of_can(dGeomID geom, dSpaceID space, double radius, double half_length, double step) {
  World world(space);
  dCreatePlane(space, 0, 0, 1, 0);
  world.set_friction(0.5);
  dMass mass;
  dMassSetCylinder(&mass, dReal(kDensity), 3, dReal(radius), dReal(2 * half_length));
  const dBodyID body = world.add(geom, mass);
  turn(body, {0, 1, 0}, std::numbers::pi / 2 + 0.03);
  dBodySetPosition(body, 0, 0, dReal(1.4 * radius));
  for (int k = 0; k * step < 6; ++k) world.quick_step(step);
  const dVector3 down = {0, 0, -1};
  dVector3 point;
  REQUIRE(snGeomSupport(geom, down, point) == 1);
  return double{point[2]};
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "a can on its side does not sink at any step") {
  constexpr double kRadius = 0.05;
  for (const double exponent : {8.0, 20.0, 60.0, 200.0}) {
    for (const double rounding : {0.0, 0.3 * kRadius}) {
      for (const double half_length : {kRadius, 5 * kRadius}) {
        for (const double step : {0.002, 0.01, 0.0167, 0.02, 0.032}) {
          CAPTURE(exponent);
          CAPTURE(rounding);
          CAPTURE(half_length);
          CAPTURE(step);
          const dSpaceID space = dHashSpaceCreate(nullptr);
          const dGeomID can = snCreateSuperellipsoid(space, dReal(kRadius - rounding), dReal(kRadius - rounding),
                                                     dReal(half_length - rounding), 2, dReal(exponent));
          if (rounding > 0) REQUIRE(snGeomSetRounding(can, dReal(rounding)) == 1);
          CHECK(lowest_point_of_can(can, space, kRadius, half_length, step) >= -0.06 * kRadius);  // a dCylinder stays above 0.94
        }
      }
    }
  }
}
