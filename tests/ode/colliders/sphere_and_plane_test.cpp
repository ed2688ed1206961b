// Bodies of ours that ODE has, too: spheres and capsules, beside ODE's own geoms.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/ode_fixture.hpp"
#include "support/ode_world.hpp"

using namespace supernormal::test;

namespace {

/// ODE's normal is the direction of a vector of length `distance` (m) with two rounded ends.
void check_same_depths(const std::vector<dContactGeom>& ours, const std::vector<dContactGeom>& theirs, double distance = 1) {
  REQUIRE(ours.size() == theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    CHECK(std::abs(ours[i].depth - theirs[i].depth) < within_rounding(1e-9));
    CHECK(norm(to_vec(ours[i].normal) - to_vec(theirs[i].normal)) < within_rounding(1e-9, 8 / distance));
  }
}

void check_same(const std::vector<dContactGeom>& ours, const std::vector<dContactGeom>& theirs, double distance = 1) {
  check_same_depths(ours, theirs, distance);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    CHECK(norm(to_vec(ours[i].pos) - to_vec(theirs[i].pos)) < within_rounding(1e-9));
  }
}

// Positions may differ along the normal, within the overlap. ODE puts the contact of a sphere and a box on the box, and of a sphere
// and a cylinder on either. Ours is halfway. For a sphere deep inside a geom ours is on the sphere, and ODE's may be beside it.
void check_same_but_for_position(const std::vector<dContactGeom>& ours, const std::vector<dContactGeom>& theirs,
                                 double distance = 1) {
  check_same_depths(ours, theirs, distance);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    const Vec apart = to_vec(ours[i].pos) - to_vec(theirs[i].pos);
    const double along = dot(apart, to_vec(ours[i].normal));
    CHECK(norm(apart - along * to_vec(ours[i].normal)) < within_rounding(1e-9));
    CHECK(std::abs(along) < ours[i].depth + within_rounding(1e-9));
  }
}

struct Pair {
  Geom ours, theirs;
};

Pair make_sphere(double radius, int kind) {
  const auto r = dReal(radius);
  Pair pair{Geom(kind == 0 ? snCreateEllipsoid(nullptr, r, r, r) : snCreateSuperellipsoid(nullptr, r / 2, r / 2, r / 2, 2, 2)),
            Geom(dCreateSphere(nullptr, r))};
  if (kind == 1) snGeomSetRounding(pair.ours, r / 2);
  return pair;
}

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "spherical bodies collide as dSphere does with dSphere, dPlane and one another") {
  Random random(10);
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    const Pair first = make_sphere(random.uniform(0.1, 2), i % 2);
    const Pair second = make_sphere(random.uniform(0.1, 2), (i / 2) % 2);
    const double sum = double{dGeomSphereGetRadius(first.theirs)} + double{dGeomSphereGetRadius(second.theirs)};
    const Vec where = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    const Vec there = where + random.uniform(0.05, 1.2) * sum * random.direction();
    for (const dGeomID geom : {dGeomID(first.ours), dGeomID(first.theirs)}) place(geom, where);
    for (const dGeomID geom : {dGeomID(second.ours), dGeomID(second.theirs)}) place(geom, there);
    random.turn(first.ours);
    random.turn(second.ours);

    const auto reference = collide(first.theirs, second.theirs);
    const double least = std::min(double{dGeomSphereGetRadius(first.theirs)}, double{dGeomSphereGetRadius(second.theirs)});
    const bool is_swallowed =
        !reference.empty() && reference[0].depth > 4 * least;  // the point halfway is beside the smaller sphere
    for (const auto& ours :
         {collide(first.ours, second.theirs), collide(first.theirs, second.ours), collide(first.ours, second.ours)}) {
      if (is_swallowed)
        check_same_but_for_position(ours, reference);
      else
        check_same(ours, reference);
    }

    const Vec n = random.direction();
    const Geom plane(dCreatePlane(nullptr, dReal(n[0]), dReal(n[1]), dReal(n[2]), dReal(dot(n, where) + random.uniform(-2, 2))));
    check_same(collide(first.ours, plane), collide(first.theirs, plane));
    check_same(collide(plane, first.ours), collide(plane, first.theirs));
  }
}

TEST_CASE_FIXTURE(
    OdeSession,
    "capsule: a capsule that falls on its side, slightly tilted, stays still at any step and max_contacts, on any geom") {
  for (const bool is_on_box : {false, true}) {
    for (const double step : {0.005, 0.02, 0.05}) {
      for (const int room : {2, 3, 4, 8}) {
        World world(dSimpleSpaceCreate(nullptr));
        world.room = room;
        world.surface.mu = dReal(0.5);
        if (is_on_box) {
          place(dCreateBox(world.space(), 4, 4, 1), {0, 0, -0.5});
        } else {
          world.add_plane();
        }
        const dBodyID body = world.add(snCreateCapsule(world.space(), dReal(0.1), dReal(0.4)), 1000);
        turn(body, {1, 0, 0}, 1.62);
        set_position(body, {0, 0, 0.3});
        double late_spin = 0;
        const int steps = static_cast<int>(5 / step);
        for (int k = 0; k < steps; ++k) {
          world.quick_step(step);
          if (k > 0.8 * steps) late_spin = std::max(late_spin, norm(to_vec(dBodyGetAngularVel(body))));
        }
        CAPTURE(is_on_box);
        CAPTURE(step);
        CAPTURE(room);
        CHECK(late_spin <= within_rounding(1e-6, 1000));  // a dCapsule on a dBox has 0.2, 1.5 and 1.9
        CHECK(dBodyGetPosition(body)[2] >= 0.0995);
      }
    }
  }
}
