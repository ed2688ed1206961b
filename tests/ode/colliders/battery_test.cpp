// The depth of points, as ODE's demo_collision.cpp checks it for its own classes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "ode/battery_bodies.hpp"
#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"

using namespace supernormal::test;

namespace {

// Allowed errors for points on the surface. Near an edge as sharp as with exponents 1.02...1.05 and 6, a point has several
// separating translations, and the solver sometimes finds a wrong one: for 0.4 % of such bodies, wrong by up to 0.4 % of their
// size.
constexpr double kMissedShare = 0.001;
constexpr double kMissedMost = 0.01;

/// Moves the body out by 0.96 of the depth, and by another 0.08, and returns whether the pair touched.
bool check_separation(dGeomID body, dGeomID collider, bool body_first) {
  const dGeomID g1 = body_first ? body : collider;
  const dGeomID g2 = body_first ? collider : body;
  const auto contacts = collide(g1, g2);
  if (contacts.empty()) return false;
  const Vec out = (body_first ? 1.0 : -1.0) * double{contacts[0].depth} * to_vec(contacts[0].normal);
  move(body, 0.96 * out);
  CHECK(!collide(g1, g2).empty());
  move(body, 0.08 * out);
  CHECK(collide(g1, g2).empty());
  return true;
}

}  // namespace

TEST_CASE("the depth of points is right at the centre, on the surface and in between") {
  OdeSession session;
  Random random(41);
  const Geom probe(dCreateSphere(nullptr, 1));
  int outside = 0;
  int inside = 0;
  int missed = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    CAPTURE(i);
    const Geom body(draw_body(random));
    const Vec centre = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
    place(body, centre);
    const double size = size_of(body);
    const double tolerance = within_rounding(2e-9 * size, 10);
    const auto depth_at = [&](const Vec& p) { return double{snGeomPointDepth(body, dReal(p[0]), dReal(p[1]), dReal(p[2]))}; };

    // The body contains the octahedron with the same half-axes, whose inscribed ball has at least this radius.
    CHECK(depth_at(centre) >= size / std::sqrt(3.0) - tolerance);
    CHECK(depth_at(centre) <= size * (1 + 1e-9));

    const Vec n = random.direction();
    const dVector3 direction = {dReal(n[0]), dReal(n[1]), dReal(n[2]), 0};
    dVector3 surface;
    REQUIRE(snGeomSupport(body, direction, surface) == 1);
    const double on_surface = std::abs(depth_at(to_vec(surface)));
    if (on_surface > tolerance) ++missed;
    CHECK(on_surface <= kMissedMost * size);
    const double out = random.uniform(0, 2);
    CHECK(std::abs(depth_at(to_vec(surface) + out * n) + out) <= tolerance);

    // Depth is concave within the body. Between the centre and the surface it is at least linear in the distance.
    const double share = random.uniform(0, 1);
    const Vec between = centre + share * (to_vec(surface) - centre);
    CHECK(depth_at(between) >= (1 - share) * depth_at(centre) - tolerance);

    const Vec anywhere = centre + random.uniform(0, 1.5) * random.direction();
    const double depth = depth_at(anywhere);
    (depth < 0 ? outside : inside) += 1;
    place(probe, anywhere);
    if (depth > -1e-3) continue;
    const double margin = std::max(-1e-5 * depth, within_rounding(0, 10));
    dGeomSphereSetRadius(probe, dReal(-depth - margin));
    CHECK(collide(probe, body).empty());
    dGeomSphereSetRadius(probe, dReal(-depth + margin));
    CHECK(collide(probe, body).size() == 1);
  }
  CHECK(missed <= kMissedShare * kRepetitions);
  CHECK(outside > kRepetitions / 10);
  CHECK(inside > kRepetitions / 10);
}

TEST_CASE("a block of triangles: moved out by 0.96 of the depth a body still touches, and by another 0.08 it is apart") {
  OdeSession session;
  Random random(43);
  int touching = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    CAPTURE(i);
    const Geom body(draw_body(random));
    const MeshGeom block(box_arrays(random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)));
    random.turn(block);
    overlap(body, block, random.uniform(0, 0.3) * size_of(body), random);
    touching += check_separation(body, block, i % 2 == 0);
  }
  CHECK(touching > 0.98 * kRepetitions);
}

TEST_CASE("a domed heightfield: moved out by 0.96 of the depth a body still touches, and by another 0.08 it is apart") {
  OdeSession session;
  Random random(44);
  const Terrain dome({17, 17, 16, 16}, [](int i, int j) { return -0.06 * ((i - 8) * (i - 8) + (j - 8) * (j - 8)); });
  const Geom heightfield(dome.create(true));
  random.turn(heightfield);
  int touching = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    CAPTURE(i);
    const Geom body(draw_body(random));
    dVector3 above;
    dGeomGetRelPointPos(heightfield, dReal(random.uniform(-3, 3)), 3, dReal(random.uniform(-3, 3)), above);
    place(body, to_vec(above));
    const snProximity apart = proximity_of(body, heightfield);
    move(body, (apart.gap + random.uniform(0, 0.3) * size_of(body)) * to_vec(apart.normal));
    touching += check_separation(body, heightfield, i % 2 == 0);
  }
  CHECK(touching > 0.98 * kRepetitions);
}
