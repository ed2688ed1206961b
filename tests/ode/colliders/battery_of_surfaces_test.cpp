// The move-out check of battery_test.cpp for the colliders with many triangles. ray_test.cpp has the check for rays.
#include <doctest/doctest.h>

#include "ode/battery_bodies.hpp"
#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"

using namespace supernormal::test;

namespace {

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
