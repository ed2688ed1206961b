// snGeomTimeOfImpact with every collider, against snGeomProximity along the path.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"
#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

snImpact impact_of(dGeomID g1, dGeomID g2, double horizon) {
  snImpact impact;
  CAPTURE(std::string(snLastError()));
  REQUIRE(snGeomTimeOfImpact(g1, g2, dReal(horizon), &impact) == 1);
  return impact;
}

double gap_of(dGeomID g1, dGeomID g2) { return proximity_of(g1, g2).gap; }

/// A body with constant velocities, and its pose at any time.
class Mover {
 public:
  Mover(dWorldID world, dGeomID geom) : body_(dBodyCreate(world)) {
    dGeomSetBody(geom, body_);
    std::copy(dBodyGetRotation(body_), dBodyGetRotation(body_) + 12, start_);
  }

  void set(const Vec& position, const Vec& velocity, const Vec& spin) {
    position_ = position;
    velocity_ = velocity;
    spin_ = spin;
    dBodySetLinearVel(body_, dReal(velocity[0]), dReal(velocity[1]), dReal(velocity[2]));
    dBodySetAngularVel(body_, dReal(spin[0]), dReal(spin[1]), dReal(spin[2]));
    go(0);
  }

  void go(double t) {
    const Vec p = position_ + t * velocity_;
    dBodySetPosition(body_, dReal(p[0]), dReal(p[1]), dReal(p[2]));
    dMatrix3 turn, rotation;
    dRFromAxisAndAngle(turn, dReal(spin_[0]), dReal(spin_[1]), dReal(spin_[2]), dReal(norm(spin_) * t));
    if (norm(spin_) == 0) dRSetIdentity(turn);
    dMultiply0(rotation, turn, start_, 3, 3, 3);
    for (int row = 0; row < 3; ++row) rotation[4 * row + 3] = 0;
    dBodySetRotation(body_, rotation);
  }

 private:
  dBodyID body_;
  dMatrix3 start_{};
  Vec position_{}, velocity_{}, spin_{};
};

}  // namespace

TEST_CASE_FIXTURE(OdeSession,
                  "time of impact: with every collider the gap is positive before and closes at the impact, in either order") {
  Random random(1);
  const double rounding = within_rounding(1e-8, 50);
  for (const ColliderKind kind : kColliderKinds) {
    int hits = 0;
    for (int k = 0; k < 60; ++k) {
      const std::string name = name_of(kind) + " " + std::to_string(k);
      CAPTURE(name);
      const World world;
      const Geom ours(random_body(random));
      const ColliderGeom collider(kind, random);
      Mover mover(world.id(), ours);
      const Vec away = random.direction();
      const bool has_offset = k % 3 == 0;
      if (has_offset) dGeomSetOffsetPosition(ours, dReal(0.3), dReal(-0.2), dReal(0.4));
      const Vec common = kind == ColliderKind::Plane ? Vec{} : random.uniform(0, 3) * random.direction();
      mover.set(6.0 * away, common - random.uniform(2, 8) * away + random.uniform(0, 2) * random.direction(),
                random.uniform(0, 5) * random.direction());
      std::unique_ptr<Mover> other;
      if (kind != ColliderKind::Plane && k % 2 == 0) {
        other = std::make_unique<Mover>(world.id(), collider);
        other->set({0, 0, 0}, common, random.uniform(0, 5) * random.direction());
      }
      if (gap_of(ours, collider) <= 0) continue;  // behind a plane
      const double horizon = 2;
      const snImpact impact = impact_of(ours, collider, horizon);
      const snImpact swapped = impact_of(collider, ours, horizon);
      CHECK(impact.converged == 1);
      CHECK(swapped.hits == impact.hits);
      CHECK(std::abs(swapped.time - impact.time) <= within_rounding(1e-14, 50));
      CHECK(norm(to_vec(impact.normal) + to_vec(swapped.normal)) <= within_rounding(2e-13, 50));
      for (int sample = 0; sample <= 60; ++sample) {
        const double t = double{impact.time} * sample / 60;
        mover.go(t);
        if (other != nullptr) other->go(t);
        CHECK(gap_of(ours, collider) >= -rounding);
      }
      if (impact.hits == 0) {
        CHECK(impact.time == dReal(horizon));
        continue;
      }
      ++hits;
      CHECK(gap_of(ours, collider) <= rounding);
      CHECK(norm(to_vec(impact.point1) - to_vec(impact.point2)) <= rounding);
      CHECK(std::abs(snGeomPointDepth(ours, impact.point1[0], impact.point1[1], impact.point1[2])) <= rounding);
    }
    CHECK(hits >= 10);
  }
}

TEST_CASE_FIXTURE(
    OdeSession, "time of impact: a body hits a sheet of triangles, at rest, moving or rotating, and misses it beyond its border") {
  const World world;
  const MeshGeom floor(sheet_mesh(20, 20, 0.5));  // 10 m x 10 m from the origin
  const Geom ball(snCreateEllipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3)));
  Mover mover(world.id(), ball);
  const double rounding = within_rounding(1e-8, 50);

  mover.set({3.2, 4.1, 2.3}, {1, 0, -4}, {0, 0, 0});
  const snImpact impact = impact_of(ball, floor, 1);
  CHECK(impact.hits == 1);
  CHECK(std::abs(impact.time - 0.5) < rounding);
  CHECK(norm(to_vec(impact.normal) - Vec{0, 0, -1}) < 1e-6);
  CHECK(norm(to_vec(impact.point1) - Vec{3.7, 4.1, 0}) < 1e-3);
  CHECK(impact_of(floor, ball, 1).normal[2] > 0.999);
  CHECK(impact_of(ball, floor, 0.49).hits == 0);

  // At 3000 m/s, past thousands of its sizes, and from below.
  mover.set({-1000 + 5, 5, 1000.3}, {1000, 0, -1000}, {300, 200, 100});
  CHECK(std::abs(impact_of(ball, floor, 2).time - 1) < 1e-3);
  mover.set({5, 5, -10.3}, {0, 0, 100}, {0, 0, 0});
  CHECK(std::abs(impact_of(ball, floor, 1).time - 0.1) < rounding);
  mover.set({-1000 + 5, 10.41, 1000.3}, {1000, 0, -1000}, {0, 0, 0});
  CHECK(impact_of(ball, floor, 2).hits == 0);

  // The floor moves up, and rotates about an axis through (5, 5).
  Mover lift(world.id(), floor);
  dGeomSetOffsetPosition(floor, -5, -5, 0);
  lift.set({5, 5, 0}, {0, 0, 4}, {0, 0, 0});
  mover.set({3.2, 4.1, 2.3}, {0, 0, 0}, {0, 0, 7});
  CHECK(std::abs(impact_of(ball, floor, 1).time - 0.5) < rounding);
  lift.set({5, 5, 0}, {0, 0, 0}, {0, 2, 0});
  mover.set({3, 5, 2}, {0, 0, 0}, {0, 0, 0});
  const snImpact flap = impact_of(ball, floor, 1);
  CHECK(flap.hits == 1);
  lift.go(flap.time);
  CHECK(std::abs(gap_of(ball, floor)) < rounding);
  lift.go(0.99 * flap.time);
  CHECK(gap_of(ball, floor) > 0);
}

TEST_CASE_FIXTURE(OdeSession, "time of impact: invalid arguments are refused") {
  const World world;
  const Geom ball(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom box(dCreateBox(nullptr, 1, 1, 1)), other(dCreateBox(nullptr, 1, 1, 1));
  place(box, {5, 0, 0});
  snImpact impact;
  CHECK(refused(snGeomTimeOfImpact(ball, nullptr, 1, &impact), "g2 = NULL"));
  CHECK(refused(snGeomTimeOfImpact(ball, box, 1, nullptr), "out = NULL"));
  CHECK(snGeomTimeOfImpact(ball, ball, 1, &impact) == 0);
  CHECK(snGeomTimeOfImpact(box, other, 1, &impact) == 0);
  for (const double horizon : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CHECK(refused(snGeomTimeOfImpact(ball, box, dReal(horizon), &impact), "horizon = "));
  }
  Mover mover(world.id(), ball);
  const dBodyID body = dGeomGetBody(ball);
  dBodySetLinearVel(body, std::numeric_limits<dReal>::infinity(), 0, 0);
  CHECK(refused(snGeomTimeOfImpact(ball, box, 1, &impact), "linear velocity of g1 = inf m/s"));
  CHECK(snGeomTimeOfImpact(box, ball, 1, &impact) == 0);
  dBodySetLinearVel(body, 1, 0, 0);
  CHECK(snGeomTimeOfImpact(box, ball, 1, &impact) == 1);
  CHECK(snGeomTimeOfImpact(box, ball, 0, &impact) == 1);
  const double spin = 0.5e75;  // rad/s; in 10 s the angle is out of range
  if (spin > double{std::numeric_limits<dReal>::max()}) return;
  dBodySetAngularVel(body, 0, 0, dReal(spin));
  CHECK(snGeomTimeOfImpact(box, ball, dReal(0.1), &impact) == 1);
  CHECK(refused(snGeomTimeOfImpact(box, ball, 10, &impact), "angular velocity of g2 = 5e+74 rad/s"));
}

TEST_CASE_FIXTURE(OdeSession, "time of impact: a heightfield without a pose is not asked for its pose") {
  const World world;
  const Terrain terrain(Terrain::Layout{}, [](int /*i*/, int /*j*/) { return 0.0; });
  const Geom field(dCreateHeightfield(nullptr, terrain.data(), 0));
  const Geom ball(snCreateEllipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3)));
  Mover mover(world.id(), ball);
  dBodySetPosition(dGeomGetBody(ball), 0, 3, 0);
  for (const double speed : {1.0, 1e20, 1e200}) {
    CAPTURE(speed);
    if (speed > double{std::numeric_limits<dReal>::max()}) continue;
    dBodySetLinearVel(dGeomGetBody(ball), 0, dReal(-speed), 0);
    snImpact impact;
    CHECK(snGeomTimeOfImpact(ball, field, 1, &impact) == (speed < 1e75 ? 1 : 0));
    if (speed > 1e75) CHECK(refused_with("linear velocity of g1 = -1e+200"));
  }
}

TEST_CASE_FIXTURE(OdeSession, "time of impact: a heightfield agrees with snGeomProximity") {
  const World world;
  const Terrain terrain({.columns = 33, .rows = 33, .width = 16, .depth = 16},
                        [](int i, int j) { return 0.5 * std::sin(0.7 * i) * std::cos(0.5 * j); });
  const Geom field(dCreateHeightfield(nullptr, terrain.data(), 1));
  const Geom ball(snCreateSuperellipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3), 3, 4));
  Mover mover(world.id(), ball);
  Random random(5);
  const double rounding = within_rounding(1e-8, 50);
  for (int k = 0; k < 20; ++k) {
    CAPTURE(k);
    mover.set({random.uniform(-4, 4), 3, random.uniform(-4, 4)},
              {random.uniform(-3, 3), random.uniform(-9, -4), random.uniform(-3, 3)}, random.uniform(0, 10) * random.direction());
    const snImpact impact = impact_of(ball, field, 1);
    CHECK(impact.hits == 1);
    for (int sample = 0; sample < 30; ++sample) {
      mover.go(double{impact.time} * sample / 30);
      CHECK(gap_of(ball, field) > 0);
    }
    mover.go(impact.time);
    CHECK(std::abs(gap_of(ball, field)) <= rounding);
  }
}
