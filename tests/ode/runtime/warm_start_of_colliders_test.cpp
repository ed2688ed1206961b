// Tests of warm start with ODE's own geoms. They have no serial numbers and are recognised by their place.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "ode/collider_fixture.hpp"

using namespace supernormal::test;

namespace {

// Crowded bodies among ODE's geoms.
struct Scene {
  std::vector<Geom> bodies;
  std::vector<ColliderGeom> colliders;

  Scene() {
    Random random(60);
    const auto anywhere = [&] { return Vec{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)}; };
    for (int i = 0; i < 30; ++i) place(bodies.emplace_back(random_body(random)), anywhere());
    for (const ColliderKind kind : kSolidKinds) {
      for (int i = 0; i < 6; ++i) place(colliders.emplace_back(kind, random), anywhere());
    }
  }

  // Returns all contacts of some steps, in which the bodies rotate and move a little.
  std::vector<dContactGeom> run() {
    Random random(61);
    std::vector<dContactGeom> all;
    for (int step = 0; step < 5; ++step) {
      for (const Geom& body : bodies) {
        for (const ColliderGeom& collider : colliders) {
          for (const dContactGeom& contact : collide(body, collider)) all.push_back(contact);
        }
        move(body, 0.01 * random.direction());
        turn_by(body, 0.02, random.direction());
      }
    }
    return all;
  }
};

}  // namespace

TEST_CASE(
    "warm start with every collider: from the second time on a separated pair costs one evaluation, and none if it cannot have "
    "met") {
  OdeSession session;
  Random random(62);
  for (const ColliderKind kind : kSolidKinds) {
    CAPTURE(name_of(kind));
    int remembered = 0;
    for (int i = 0; i < 50; ++i) {
      const Geom body(random_body(random));
      const ColliderGeom collider(kind, random);
      place(collider, 4.0 * random.direction());
      CHECK(collide(body, collider).empty());
      move(body, 1e-3 * random.direction());
      snResetStatistics();
      CHECK(collide(body, collider).empty());
      if (kind == ColliderKind::Body) CHECK(statistics().queries_warm == 1);
      if (statistics().queries_warm == 0) continue;  // its direction is now in another cell
      ++remembered;
      // Of two of our bodies the last gap is known, and the motion cannot have closed it.
      CHECK(statistics().evaluations_warm == (kind == ColliderKind::Body ? 0 : 1));
    }
    CHECK(remembered > 40);
  }
}

TEST_CASE("a body that rolls across a wide dBox keeps its warm start, at three evaluations") {
  OdeSession session;
  const Geom floor(dCreateBox(nullptr, 100, 100, 1));
  const Geom ball(snCreateEllipsoid(nullptr, dReal(0.5), dReal(0.45), dReal(0.4)));
  constexpr int kSteps = 1000;
  constexpr double kStep = 0.01;
  for (int step = 0; step < kSteps; ++step) {
    place(ball, {-5 + kStep * step, 3, 0.9});
    turn_by(ball, kStep / 0.45, {0, 1, 0});
    collide(ball, floor);
  }
  const snStatistics s = statistics();
  CHECK(s.contacts > kSteps / 2);
  CHECK(s.queries_warm > 0.97 * kSteps);
  CHECK(s.evaluations_warm < 3 * s.queries_warm);
}

TEST_CASE("warm start with every collider: in a new place the answer is the answer of a cold start") {
  OdeSession session;
  Random random(63);
  for (const ColliderKind kind : kSolidKinds) {
    CAPTURE(name_of(kind));
    int touching = 0;
    for (int i = 0; i < 200; ++i) {
      CAPTURE(i);
      const Geom body(random_body(random));
      const ColliderGeom first(kind, random);
      const ColliderGeom second(kind, random);
      overlap(body, first, 0.2 * size_of(body), random);
      collide(body, first);
      place(second, to_vec(dGeomGetPosition(first)));
      overlap(body, second, 0.1 * size_of(body), random);
      const auto warm = collide(body, second);
      snSetWarmStart(0);
      const auto cold = collide(body, second);
      snSetWarmStart(1);
      REQUIRE(warm.size() == cold.size());
      if (cold.empty()) continue;
      ++touching;
      CHECK(std::abs(warm[0].depth - cold[0].depth) < 3e-9);
    }
    CHECK(touching > 190);
  }
}

TEST_CASE("warm start with every collider: the same scene built again gives the same bits, at any addresses and cache contents") {
  OdeSession session;
  std::vector<dContactGeom> first;
  {
    Scene scene;
    first = scene.run();
  }
  REQUIRE(first.size() > 400);
  std::vector<Geom> in_the_way;
  in_the_way.reserve(100);
  for (int i = 0; i < 100; ++i) in_the_way.emplace_back(dCreateBox(nullptr, 1, 1, 1));
  Scene scene;
  CHECK(same_bits(scene.run(), first));
  CHECK(statistics().queries_warm > statistics().queries_cold);
}
