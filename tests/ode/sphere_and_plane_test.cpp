// Sphere-shaped bodies against ODE's spheres and planes, where ODE's own contacts are the reference.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "ode/ode_fixture.hpp"

using namespace supernormal::test;

namespace {

void check_same(const std::vector<dContactGeom>& ours, const std::vector<dContactGeom>& theirs) {
  REQUIRE(ours.size() == theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    CHECK(std::abs(ours[i].depth - theirs[i].depth) < 1e-9);
    CHECK(norm(to_vec(ours[i].normal) - to_vec(theirs[i].normal)) < 1e-9);
    CHECK(norm(to_vec(ours[i].pos) - to_vec(theirs[i].pos)) < 1e-9);
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

TEST_CASE("as dSphere against dSphere, dPlane and one another") {
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
    check_same(collide(first.ours, second.theirs), reference);
    check_same(collide(first.theirs, second.ours), reference);
    check_same(collide(first.ours, second.ours), reference);

    const Vec n = random.direction();
    const Geom plane(dCreatePlane(nullptr, dReal(n[0]), dReal(n[1]), dReal(n[2]), dReal(dot(n, where) + random.uniform(-2, 2))));
    check_same(collide(first.ours, plane), collide(first.theirs, plane));
    check_same(collide(plane, first.ours), collide(plane, first.theirs));
  }
}

TEST_CASE("an ellipsoid and a plane: the closed form") {
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
    CHECK(contacts[0].depth == doctest::Approx(depth).epsilon(1e-13));
    CHECK(norm(to_vec(contacts[0].normal) - n) < 1e-14);
    CHECK(dot(to_vec(contacts[0].pos), n) == doctest::Approx(lowest).epsilon(1e-13));
  }
}

TEST_CASE("partners that are not supported: no contacts, and the reason") {
  OdeSession session;
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, 1));
  const Geom box(dCreateBox(nullptr, 1, 1, 1));
  const Geom capsule(dCreateCapsule(nullptr, 1, 1));
  const Geom cylinder(dCreateCylinder(nullptr, 1, 1));
  const Geom ray(dCreateRay(nullptr, 3));
  const std::vector<std::pair<dGeomID, std::string>> partners = {
      {box, "dBox"}, {capsule, "dCapsule"}, {cylinder, "dCylinder"}, {ray, "dRay"}};
  for (const auto& [partner, class_name] : partners) {
    const std::string& name = class_name;
    CAPTURE(name);
    CHECK(collide(body, partner).empty());
    CHECK(collide(partner, body).empty());
    CHECK(std::string(snLastError()).find("dCollide: the partner is a " + name) == 0);
    snProximity answer;
    CHECK(snGeomProximity(body, partner, &answer) == 0);
    CHECK(std::string(snLastError()).find("the partner is a " + name) != std::string::npos);
  }
}
