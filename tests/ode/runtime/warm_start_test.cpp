// Tests that warm start saves evaluations and changes nothing else. Without it, results are a function of the poses.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "ode/collider_fixture.hpp"
#include "support/ode_fixture.hpp"

using namespace supernormal::test;

namespace {

// Makes a lattice of rotated bodies that touch their neighbours.
std::vector<Geom> make_pile(int per_side) {
  Random random(23);
  std::vector<Geom> pile;
  for (int x = 0; x < per_side; ++x) {
    for (int y = 0; y < per_side; ++y) {
      for (int z = 0; z < per_side; ++z) {
        pile.emplace_back(random_body(random));
        place(pile.back(), {1.9 * x, 1.9 * y, 1.9 * z});
      }
    }
  }
  return pile;
}

// Makes two steps: every pair of the pile, a small motion, every pair again. Returns all contacts.
std::vector<dContactGeom> two_steps(std::vector<Geom>& pile) {
  std::vector<dContactGeom> all;
  for (int step = 0; step < 2; ++step) {
    for (std::size_t i = 0; i < pile.size(); ++i) {
      for (std::size_t j = i + 1; j < pile.size(); ++j) {
        for (const dContactGeom& contact : collide(pile[i], pile[j])) all.push_back(contact);
      }
    }
    for (std::size_t i = 0; i < pile.size(); ++i) move(pile[i], {1e-3 * static_cast<double>(i % 3), 0, 0});
  }
  return all;
}

// Runs the thread's own scene, from its creation to its contacts. (ODE computes poses lazily, inside the geom.)
std::vector<dContactGeom> run_scene() {
  dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  auto pile = make_pile(4);
  const Geom plane(dCreatePlane(nullptr, 0, 0, 1, 1));
  const Geom sphere(dCreateSphere(nullptr, 3));
  std::vector<dContactGeom> all;
  for (int i = 0; i < 5; ++i) {
    for (const dContactGeom& contact : two_steps(pile)) all.push_back(contact);
    for (const Geom& geom : pile) {
      for (const dGeomID other : {dGeomID(plane), dGeomID(sphere)}) {
        for (const dContactGeom& contact : collide(geom, other)) all.push_back(contact);
      }
    }
  }
  return all;
}

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

TEST_CASE_FIXTURE(OdeSession, "warm start: a touching pair that hardly moved costs two evaluations") {
  Random random(25);
  std::vector<unsigned long long> counts;
  for (int i = 0; i < 100; ++i) {
    const Geom g1(random_body(random));
    const Geom g2(random_body(random));
    place(g2, 1.8 * random.direction());
    if (collide(g1, g2).empty()) continue;
    move(g1, 1e-3 * random.direction());
    snResetStatistics();
    collide(g1, g2);
    counts.push_back(statistics().evaluations_warm);
  }
  REQUIRE(counts.size() > 30);
  std::sort(counts.begin(), counts.end());
  CHECK(counts[counts.size() / 2] <= 2);
}

TEST_CASE_FIXTURE(OdeSession, "warm start: a pair that the program has moved far starts cold, with the answer of a cold start") {
  Random random(27);
  for (int i = 0; i < 400; ++i) {
    CAPTURE(i);
    const auto half = [&] { return dReal(random.uniform(0.4, 1)); };
    const dReal axes[3] = {half(), half(), half()};
    const auto exponent = dReal(i % 2 == 0 ? random.uniform(50, 200) : random.uniform(1.05, 1.3));
    const Geom g1(snCreateSuperellipsoid(nullptr, axes[0], axes[1], axes[2], exponent, exponent));
    const Geom g2(snCreateSuperellipsoid(nullptr, axes[2], axes[0], axes[1], exponent, exponent));
    const Geom sphere(dCreateSphere(nullptr, dReal(0.5)));
    random.turn(g2);
    const Vec deep_inside = 0.35 * random.direction();  // both centres are in both bodies
    const Vec starts[] = {3.0 * random.direction(), -1.0 * deep_inside, (3 / 0.35) * deep_inside};  // elsewhere, behind, far ahead
    for (const dGeomID collider : {dGeomID(g2), dGeomID(sphere)}) {
      CAPTURE(collider == dGeomID(sphere));
      snSetWarmStart(0);
      place(collider, deep_inside);
      const auto cold = collide(g1, collider, 1);
      REQUIRE(cold.size() == 1);
      snSetWarmStart(1);
      for (const Vec& start : starts) {
        place(collider, start);
        collide(g1, collider);
        place(collider, deep_inside);
        snResetStatistics();
        const auto moved = collide(g1, collider, 1);
        // The sphere has a cache entry for each earlier direction, and may be back at an earlier place. The cached answer is the
        // same.
        if (collider == dGeomID(g2)) CHECK(statistics().queries_cold == 1);
        REQUIRE(moved.size() == 1);
        CHECK(std::abs(moved[0].depth - cold[0].depth) < within_rounding(2e-9));
        CHECK(norm(to_vec(moved[0].normal) - to_vec(cold[0].normal)) < 1e-4);
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "warm start: a pair that has rotated far starts cold") {
  const Geom g1(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 8, 8));
  const Geom g2(snCreateSuperellipsoid(nullptr, 1, dReal(0.8), dReal(0.6), 8, 8));
  place(g2, {1.2, 0.4, 0.3});
  collide(g1, g2);
  const auto is_warm_after_turn = [&](double angle) {
    dQuaternion q;
    dQFromAxisAndAngle(q, 1, 2, 3, dReal(angle));
    dGeomSetQuaternion(g2, q);
    snResetStatistics();
    collide(g1, g2);
    return statistics().queries_warm == 1;
  };
  CHECK(is_warm_after_turn(0.4));
  CHECK_FALSE(is_warm_after_turn(1.0));
  CHECK(is_warm_after_turn(1.4));
  CHECK_FALSE(is_warm_after_turn(0.7));
}

TEST_CASE_FIXTURE(OdeSession, "warm start: a pair with a changed shape starts cold, with the answer of a cold start") {
  Random random(28);
  const auto half = [&] { return dReal(random.uniform(0.4, 1)); };
  const auto exponent = [&] { return dReal(random.uniform(0, 1) < 0.5 ? random.uniform(1.1, 2) : random.uniform(10, 100)); };
  using Change = std::function<void(dGeomID)>;
  const Change lengths = [&](dGeomID geom) {
    CHECK(snGeomSuperellipsoidSetParams(geom, half(), half(), half(), exponent(), exponent()) == 1);
  };
  const Change taper = [&](dGeomID geom) {
    CHECK(snGeomSuperovoidSetParams(geom, half(), half(), half(), 3, 2, dReal(random.uniform(-0.5, 0.5)), 0) == 1);
  };
  const Change rounding = [&](dGeomID geom) { CHECK(snGeomSetRounding(geom, half()) == 1); };
  const Change box = [&](dGeomID geom) { dGeomBoxSetLengths(geom, half(), half(), half()); };
  const Change capsule = [&](dGeomID geom) { dGeomCapsuleSetParams(geom, half(), half()); };
  const Change cylinder = [&](dGeomID geom) { dGeomCylinderSetParams(geom, half(), half()); };
  // The vertices of a tetrahedron are mirrored: the same number, in the same box.
  std::array<dReal, 12> vertices = {-1, -1, -1, 1, dReal(0.8), -1, dReal(-0.6), 1, -1, dReal(0.1), dReal(0.2), 1};
  std::array<dReal, 4> plane = {0, 0, -1, 1};
  std::array<unsigned int, 4> polygon = {3, 0, 2, 1};
  const Change convex = [&](dGeomID geom) {
    for (std::size_t k = 0; k < vertices.size(); k += 3) vertices.at(k) *= -1;
    std::swap(polygon[2], polygon[3]);  // counter-clockwise again
    dGeomSetConvex(geom, plane.data(), 1, vertices.data(), 4, polygon.data());
    dGeomMoved(geom);
  };
  const auto superellipsoid = [&] { return snCreateSuperellipsoid(nullptr, half(), half(), half(), exponent(), exponent()); };
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    const std::pair<dGeomID, Change> changing[] = {
        {superellipsoid(), lengths},
        {superellipsoid(), rounding},
        {snCreateSuperovoid(nullptr, half(), half(), half(), 3, 2, dReal(0.2), 0), taper},
        {dCreateBox(nullptr, half(), half(), half()), box},
        {dCreateCapsule(nullptr, half(), half()), capsule},
        {dCreateCylinder(nullptr, half(), half()), cylinder},
        {dCreateConvex(nullptr, plane.data(), 1, vertices.data(), 4, polygon.data()), convex}};
    const Geom other(superellipsoid());
    random.turn(other);
    for (const auto& [id, change] : changing) {
      const Geom geom(id);
      CAPTURE(dGeomGetClass(geom));
      place(geom, 0.2 * random.direction());
      collide(geom, other);
      change(geom);
      snResetStatistics();
      const auto changed = collide(geom, other, 1);
      CHECK(statistics().queries_cold == 1);
      collide(geom, other, 1);
      CHECK(statistics().queries_warm == 1);  // it is a cache hit from then on
      snSetWarmStart(0);
      const auto cold = collide(geom, other, 1);
      snSetWarmStart(1);
      CHECK(same_bits(changed, cold));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "warm start: a geom at the address of a destroyed one starts cold") {
  const Geom g1(snCreateEllipsoid(nullptr, 1, dReal(0.8), dReal(0.6)));
  for (int i = 0; i < 20; ++i) {
    const Geom g2(snCreateEllipsoid(nullptr, 1, 1, dReal(0.7)));
    place(g2, {1.2, 0.4, 0.3});
    snResetStatistics();
    CHECK(collide(g1, g2).size() == 1);
    CHECK(statistics().queries_cold == 1);
  }
}

TEST_CASE_FIXTURE(OdeSession, "warm start: two threads at a time find the contacts of one") {
  for (const bool warm_start : {false, true}) {
    CAPTURE(warm_start);
    snSetWarmStart(warm_start ? 1 : 0);
    const auto serial = run_scene();
    REQUIRE(serial.size() > 500);
    std::array<std::vector<dContactGeom>, 2> parallel;
    std::vector<std::thread> threads;
    threads.reserve(parallel.size());
    for (auto& out : parallel) threads.emplace_back([&out] { out = run_scene(); });
    for (std::thread& thread : threads) thread.join();
    for (const auto& out : parallel) {
      REQUIRE(out.size() == serial.size());
      if (!warm_start) CHECK(same_bits(out, serial));
      for (std::size_t i = 0; i < out.size(); ++i) CHECK(std::abs(out[i].depth - serial[i].depth) < 3e-9);
    }
  }
}

TEST_CASE_FIXTURE(
    OdeSession,
    "warm start with every collider: from the second time on a separated pair costs one evaluation, and none if it cannot have "
    "met") {
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

TEST_CASE_FIXTURE(OdeSession, "a body that rolls across a wide dBox keeps its warm start, at three evaluations") {
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

TEST_CASE_FIXTURE(OdeSession, "warm start with every collider: in a new place the answer is the answer of a cold start") {
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

TEST_CASE_FIXTURE(OdeSession, "warm start: the same scene built again gives the same bits, at any addresses and cache contents") {
  const auto run_pile = [] {
    auto pile = make_pile(8);  // 130 816 pairs, as many as the table holds: some are evicted, the same ones in every run
    return two_steps(pile);
  };
  const auto run_crowd = [] { return Scene().run(); };
  const std::function<std::vector<dContactGeom>()> scenes[] = {run_pile, run_crowd};
  for (const auto& run : scenes) {
    const auto first = run();
    REQUIRE(first.size() > 400);
    std::vector<Geom> in_the_way;
    in_the_way.reserve(100);
    for (int i = 0; i < 100; ++i)
      in_the_way.emplace_back(i % 2 == 0 ? dCreateBox(nullptr, 1, 1, 1) : snCreateEllipsoid(nullptr, 1, 1, 1));
    snResetStatistics();
    CHECK(same_bits(run(), first));
  }
  CHECK(statistics().queries_warm > statistics().queries_cold);
}
