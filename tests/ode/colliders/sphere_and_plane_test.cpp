// Spherical bodies against ODE's own geoms. ODE's contacts of dSphere are the reference.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/ode_fixture.hpp"

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

TEST_CASE("spherical bodies collide as dSphere does with dSphere, dPlane and one another") {
  OdeSession session;
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

TEST_CASE("an ellipsoid and a plane have the depth of the closed form") {
  OdeSession session;
  Random random(11);
  const Vec axes = {0.5, 1.0, 1.7};
  const Geom geom(snCreateEllipsoid(nullptr, dReal(axes[0]), dReal(axes[1]), dReal(axes[2])));
  for (int i = 0; i < 200; ++i) {
    random.turn(geom);
    place(geom, {1, 2, 3});
    const Vec n = random.direction();
    const double depth = random.uniform(0, 1);
    const dReal* const R = dGeomGetRotation(geom);
    Vec scaled{};
    for (std::size_t k = 0; k < 3; ++k) scaled[k] = axes[k] * (R[k] * n[0] + R[4 + k] * n[1] + R[8 + k] * n[2]);
    const double lowest = dot(n, {1, 2, 3}) - norm(scaled);
    const Geom plane(dCreatePlane(nullptr, dReal(n[0]), dReal(n[1]), dReal(n[2]), dReal(lowest + depth)));
    const auto contacts = collide(geom, plane);
    REQUIRE(contacts.size() == 1);
    CHECK(std::abs(contacts[0].depth - depth) < within_rounding(1e-14));  // differences of numbers of metres
    CHECK(norm(to_vec(contacts[0].normal) - n) < within_rounding(1e-14));
    CHECK(std::abs(dot(to_vec(contacts[0].pos), n) - lowest) < within_rounding(1e-14));
  }
}

namespace {

// The half-lengths along the axes.
Vec half_lengths(dGeomID geom) {
  dReal radius = 0;
  dReal length = 0;
  dVector3 lengths;
  switch (dGeomGetClass(geom)) {
    case dBoxClass:
      dGeomBoxGetLengths(geom, lengths);
      return 0.5 * to_vec(lengths);
    case dCapsuleClass:
      dGeomCapsuleGetParams(geom, &radius, &length);
      return {radius, radius, 0.5 * length + radius};
    default:
      dGeomCylinderGetParams(geom, &radius, &length);
      return {radius, radius, 0.5 * length};
  }
}

// Whether a place is beside the geom. Halfway between the tangent planes it may be beyond a thin geom. Our contact is then in the
// geom.
bool is_beside(const Vec& place, dGeomID geom) {
  const Vec half = half_lengths(geom);
  dVector3 local;
  dGeomGetPosRelPoint(geom, dReal(place[0]), dReal(place[1]), dReal(place[2]), local);
  const double across = std::hypot(local[0], local[1]), along = std::abs(local[2]);
  switch (dGeomGetClass(geom)) {
    case dBoxClass:
      return along > half[2] || std::abs(local[0]) > half[0] || std::abs(local[1]) > half[1];
    case dCapsuleClass:
      return std::hypot(across, std::max(0.0, along - (half[2] - half[0]))) > half[0];
    default:
      return along > half[2] || across > half[0];
  }
}

// A point near the geom, in its frame. It is outside of a box or cylinder, because ODE's answers differ inside.
Vec draw_near(dGeomID geom, double distance, Random& random) {
  const Vec half = half_lengths(geom);
  while (true) {
    Vec point{};
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = random.uniform(-1, 1) * (half[axis] + distance);
    const bool is_beyond_ends = std::abs(point[2]) > half[2];
    const bool is_beside = dGeomGetClass(geom) == dBoxClass ? std::abs(point[0]) > half[0] || std::abs(point[1]) > half[1]
                                                            : std::hypot(point[0], point[1]) > half[0];
    if (is_beyond_ends || is_beside || dGeomGetClass(geom) == dCapsuleClass) return point;
  }
}

}  // namespace

TEST_CASE("spherical bodies collide as dSphere does with dBox, dCapsule and dCylinder") {
  OdeSession session;
  snSetDefaultSolver(SN_SOLVER_HYBRID, dReal(1e-15), 1000);  // the normal is accurate to the root of the tolerance
  Random random(12);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    CAPTURE(i);
    const double radius = random.uniform(0.1, 2);
    const Pair sphere = make_sphere(radius, i % 2);
    const auto length = [&] { return dReal(random.uniform(0.1, 3)); };
    const dReal lengths[3] = {length(), length(), length()};
    const Geom box(dCreateBox(nullptr, lengths[0], lengths[1], lengths[2]));
    const Geom capsule(dCreateCapsule(nullptr, lengths[0], lengths[1]));
    const Geom cylinder(dCreateCylinder(nullptr, lengths[0], lengths[1]));
    for (const dGeomID collider : {dGeomID(box), dGeomID(capsule), dGeomID(cylinder)}) {
      CAPTURE(dGeomGetClass(collider));
      place(collider, {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)});
      random.turn(collider);
      const Vec local = draw_near(collider, radius, random);
      dVector3 centre;
      dGeomGetRelPointPos(collider, dReal(local[0]), dReal(local[1]), dReal(local[2]), centre);
      for (const dGeomID geom : {dGeomID(sphere.ours), dGeomID(sphere.theirs)}) place(geom, to_vec(centre));
      random.turn(sphere.ours);
      for (const bool sphere_first : {true, false}) {
        const auto of = [&](dGeomID geom) { return sphere_first ? collide(geom, collider) : collide(collider, geom); };
        const auto reference = of(sphere.theirs);
        touching += static_cast<int>(reference.size());
        const double from_centre = reference.empty() ? 1 : std::min(1.0, std::abs(radius - double{reference[0].depth}));
        // The place halfway between the tangent planes, where the sphere may be wholly above.
        const double depth = reference.empty() ? 0 : double{reference[0].depth};
        const Vec into = reference.empty() ? Vec{} : (sphere_first ? -1.0 : 1.0) * to_vec(reference[0].normal);
        if (depth > 4 * radius || (depth > 0 && is_beside(to_vec(centre) + (radius - 0.5 * depth) * into, collider))) {
          check_same_depths(of(sphere.ours), reference, from_centre);
        } else if (collider != dGeomID(capsule)) {
          check_same_but_for_position(of(sphere.ours), reference, from_centre);
        } else {
          check_same(of(sphere.ours), reference, from_centre);
        }
      }
    }
  }
  CHECK(touching > 6000);
}
