// Bodies of ours that ODE has, too: spheres, capsules and eggs, beside ODE's own geoms and closed forms.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/ode_fixture.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

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

constexpr dReal kRadius = 2, kLength = 5;

struct EggParameters {
  dReal a = 0, b = 0, c = 0, delta = 0, epsilon = 0, taper_x = 0, taper_y = 0;
  explicit EggParameters(dGeomID geom) {
    REQUIRE(snGeomSuperovoidGetParams(geom, &a, &b, &c, &delta, &epsilon, &taper_x, &taper_y) == 1);
  }
  bool operator==(const EggParameters&) const = default;
};

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

TEST_CASE_FIXTURE(OdeSession, "capsule: size, mass and depth are equal to ODE's") {
  const Geom ours(snCreateCapsule(nullptr, kRadius, kLength));
  REQUIRE(ours != nullptr);
  const Geom odes(dCreateCapsule(nullptr, kRadius, kLength));
  dMatrix3 turn;
  dRFromAxisAndAngle(turn, 1, dReal(0.5), dReal(0.2), dReal(0.7));
  std::array<std::array<dReal, 6>, 2> boxes{};
  for (const auto geom : {static_cast<dGeomID>(ours), static_cast<dGeomID>(odes)}) {
    dGeomSetRotation(geom, turn);
    dGeomGetAABB(geom, boxes[geom == static_cast<dGeomID>(odes) ? 1 : 0].data());
  }
  // Ours is wider by the rounding error that it must cover.
  const double tolerance = within_rounding(1e-6, kRadius + 0.5 * kLength);
  for (std::size_t i = 0; i < 6; ++i) {
    const double wider = (i % 2 == 0 ? -1 : 1) * (double{boxes[0][i]} - double{boxes[1][i]});
    CHECK(wider < tolerance);
    CHECK(wider > -0.1 * tolerance);
  }
  dMass mass, expected;
  REQUIRE(snMassSet(&mass, 3, ours) == 1);
  dMassSetCapsule(&expected, 3, 3, kRadius, kLength);
  CHECK(mass.mass == relative(expected.mass).epsilon(1e-6));
  for (const int i : {0, 5, 10}) CHECK(mass.I[i] == relative(expected.I[i]).epsilon(1e-6));
  for (const dReal x : {dReal(0), dReal(1), dReal(3)}) {
    CHECK(std::abs(snGeomPointDepth(ours, x, 1, 2) - dGeomCapsulePointDepth(odes, x, 1, 2)) < 1e-6);
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

TEST_CASE_FIXTURE(OdeSession, "capsule: invalid parameters are refused") {
  CHECK(refused(snCreateCapsule(nullptr, 0, 1), "snCreateCapsule: radius = 0"));
  CHECK(refused(snCreateCapsule(nullptr, 1, -1), "snCreateCapsule: length = -1"));
  const Geom ball(snCreateCapsule(nullptr, 1, 0));
  CHECK(ball != nullptr);
}

TEST_CASE_FIXTURE(OdeSession, "superovoid: parameters are kept, changed and refused") {
  const Geom egg(snCreateSuperovoid(nullptr, 3, 2, 1, 2.5, 4, 0.5, 0.5));
  REQUIRE(egg != nullptr);
  const EggParameters first(egg);
  CHECK(first.c == 1);
  CHECK(first.epsilon == 4);
  CHECK(first.taper_y == dReal(0.5));
  dReal box[6];
  dGeomGetAABB(egg, box);
  CHECK(box[5] == relative(1));

  CHECK(snGeomSuperovoidSetParams(egg, 1, 1, 2, 2, 2, dReal(-0.25), dReal(0.25)) == 1);
  dGeomGetAABB(egg, box);
  CHECK(box[5] == relative(2));
  const EggParameters second(egg);
  CHECK(refused(snGeomSuperovoidSetParams(egg, 1, 1, 2, 2, 2, dReal(0.75), 0),
                "snGeomSuperovoidSetParams: taper_x = 0.75 is outside [-0.70710678118"));
  CHECK(EggParameters(egg) == second);
  CHECK(refused(snGeomSuperovoidGetParams(egg, box, box, box, box, box, box, nullptr), "taper_y = NULL"));

  CHECK(refused(snCreateSuperovoid(nullptr, 1, 1, 1, 2, 3, dReal(0.25), dReal(0.5)),
                "snCreateSuperovoid: taper_x = 0.25 and taper_y = 0.5 differ, but with epsilon = 3"));
  CHECK(refused(snCreateSuperovoid(nullptr, 1, -1, 1, 2, 3, 0, 0), "half-axis b = -1 m"));
}

TEST_CASE_FIXTURE(OdeSession, "superovoid: the functions of one kind of body refuse other kinds") {
  const Geom egg(snCreateSuperovoid(nullptr, 3, 2, 1, 2, 2, 0, 0));
  const Geom ellipsoid(snCreateEllipsoid(nullptr, 3, 2, 1));
  CHECK(refused(snGeomSuperovoidSetParams(ellipsoid, 1, 1, 1, 2, 2, 0, 0), "geom is a superellipsoid, but must be a superovoid"));
  CHECK(refused(snGeomSuperellipsoidSetParams(egg, 1, 1, 1, 2, 2),
                "geom is a superovoid, but must be an ellipsoid or a superellipsoid"));
}

TEST_CASE_FIXTURE(OdeSession, "superovoid: an egg has the mass and the centre of mass of the closed form") {
  const double a = 0.3, c = 0.4, taper = 0.3, density = 1000;
  const Geom egg(snCreateSuperovoid(nullptr, dReal(a), dReal(a), dReal(c), 2, 2, dReal(taper), dReal(taper)));
  dMass mass;
  REQUIRE(snMassSet(&mass, dReal(density), egg) == 1);
  CHECK(mass.mass == relative(density * 4 / 3 * std::numbers::pi * a * a * c * (1 + taper * taper / 5)).epsilon(1e-6));
  CHECK(mass.c[2] == relative(c * 2 * taper / 5 / (1 + taper * taper / 5)).epsilon(1e-6));
}
