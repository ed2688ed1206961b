// Tests of dCollide's contract: order, normal, depth, skip, flags, fields; and the depth of points, as ODE's demo_collision.cpp
// checks it for its own classes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ode/collider_fixture.hpp"
#include "ode/mesh_fixture.hpp"
#include "ode/terrain.hpp"
#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

// Makes a collider that overlaps a body at the origin (half-axes 0.5...1.5) or stays just clear of it.
ColliderGeom make_collider(ColliderKind kind, Random& random) {
  ColliderGeom collider(kind, random);
  if (kind != ColliderKind::Plane) place(collider, random.uniform(0.6, 1.8) * random.direction());
  return collider;
}

// Makes one collider of every kind, around a point.
std::vector<ColliderGeom> make_colliders_at(const Vec& point) {
  Random random(7);
  std::vector<ColliderGeom> colliders;
  for (const ColliderKind kind : kColliderKinds) {
    colliders.emplace_back(kind, random);
    if (kind != ColliderKind::Plane) place(colliders.back(), point);
  }
  return colliders;
}

// Checks that the normal is of unit length and points into g1, and that the depth is valid.
void check_contact(const dContactGeom& contact, dGeomID g1, dGeomID g2) {
  CHECK(contact.g1 == g1);
  CHECK(contact.g2 == g2);
  CHECK(contact.side1 == -1);
  CHECK(contact.side2 == -1);
  CHECK(norm(to_vec(contact.normal)) == relative(1).epsilon(within_rounding(1e-14)));
  CHECK(contact.depth >= 0);
  CHECK(std::isfinite(norm(to_vec(contact.pos))));
}

// The last error is known to be new, because an error of another kind was there before.
void check_no_contact(dGeomID one, dGeomID other) {
  CHECK(snGeomSetRounding(nullptr, 1) == 0);
  CHECK(collide(one, other).empty());
  const std::string error = snLastError();
  CAPTURE(dGeomGetClass(one));
  CAPTURE(dGeomGetClass(other));
  CHECK(error.find("dCollide: the pose of ") == 0);
  CHECK(error.find("nan") != std::string::npos);
}

// Allowed errors for points on the surface. Near an edge as sharp as with exponents 1.02...1.05 and 6, a point has several
// separating translations, and the solver sometimes finds a wrong one: for 0.4 % of such bodies, wrong by up to 0.4 % of their
// size.
constexpr double kMissedShare = 0.001;
constexpr double kMissedMost = 0.01;

/// Moves the body out by 0.96 of the depth, and by another 0.08, and returns whether the pair touched. A pair of convex geoms has
/// one normal: the other contacts are the manifold points of a flat overlap.
bool check_separation(dGeomID body, dGeomID collider, bool body_first, bool is_convex = false) {
  const dGeomID g1 = body_first ? body : collider;
  const dGeomID g2 = body_first ? collider : body;
  const auto contacts = collide(g1, g2);
  if (contacts.empty()) return false;
  if (is_convex) check_contact(contacts[0], g1, g2);
  for (const dContactGeom& contact : contacts) {
    CHECK(contact.depth >= 0);
    CHECK(contact.depth <= contacts[0].depth);
    if (is_convex) CHECK(to_vec(contact.normal) == to_vec(contacts[0].normal));
  }
  const Vec out = (body_first ? 1.0 : -1.0) * double{contacts[0].depth} * to_vec(contacts[0].normal);
  move(body, 0.96 * out);
  CHECK(!collide(g1, g2).empty());
  move(body, 0.08 * out);
  CHECK(collide(g1, g2).empty());
  return true;
}

}  // namespace

// The check of ODE's demo_collision.cpp for its own classes.
TEST_CASE_FIXTURE(OdeSession, "moved out by 0.96 of a contact's depth geoms still touch, and by another 0.08 they are apart") {
  const int repetitions = draws(4000);
  for (const ColliderKind kind : kColliderKinds) {
    CAPTURE(name_of(kind));
    Random random(40);
    int touching = 0;
    for (int i = 0; i < repetitions; ++i) {
      CAPTURE(i);
      const Geom body(draw_body(random));
      const ColliderGeom collider = kind == ColliderKind::Body ? ColliderGeom(draw_body(random)) : ColliderGeom(kind, random);
      overlap(body, collider, random.uniform(within_rounding(0, 30), 0.3) * size_of(body), random);
      touching += check_separation(body, collider, i % 2 == 0, true);
    }
    CHECK(touching > 0.98 * repetitions);
  }
}

TEST_CASE_FIXTURE(OdeSession, "both call orders give the same contact with the reversed normal") {
  Random random(2);
  for (const bool warm_start : {true, false}) {
    snSetWarmStart(warm_start ? 1 : 0);
    for (const ColliderKind kind : kColliderKinds) {
      for (int i = 0; i < 100; ++i) {
        const Geom body(random_body(random));
        const ColliderGeom collider(make_collider(kind, random));
        collide(body, collider);  // so that both of the following find the same cached normal
        collide(body, collider);
        const auto forth = collide(body, collider);
        const auto back = collide(collider, body);
        REQUIRE(forth.size() == back.size());
        if (forth.empty()) continue;
        CHECK(forth[0].g1 == back[0].g2);
        CHECK(forth[0].g2 == back[0].g1);
        CHECK(norm(to_vec(forth[0].normal) + to_vec(back[0].normal)) <= within_rounding(1e-8, 4));
        CHECK(forth[0].depth == relative(back[0].depth).epsilon(1e-8));
        if (warm_start) continue;
        for (int axis = 0; axis < 3; ++axis) {  // a pure function of the poses, to the last bit
          CHECK(forth[0].normal[axis] == -back[0].normal[axis]);
          CHECK(forth[0].pos[axis] == back[0].pos[axis]);
        }
        CHECK(forth[0].depth == back[0].depth);
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "skip and flags: nothing is written outside of the requested contacts") {
  const Geom body(snCreateSuperellipsoid(nullptr, 1, 1, 1, 4, 4));
  const auto colliders = make_colliders_at({0.7, 0.3, 0});

  constexpr unsigned char kUntouched = 0xA5;
  constexpr int kSlots = 4;
  for (const ColliderGeom& collider : colliders) {
    for (const std::size_t skip : {sizeof(dContactGeom), sizeof(dContact), sizeof(dContactGeom) + 40}) {
      for (const unsigned flags : {1U, 4U, 0x00070001U, 0x80000001U, 0x80000004U, 0xffffU}) {
        std::vector<unsigned char> memory(kSlots * skip, kUntouched);
        auto* const contacts = reinterpret_cast<dContactGeom*>(memory.data());
        const int count = dCollide(body, collider, static_cast<int>(flags), contacts, static_cast<int>(skip));
        REQUIRE(count == 1);
        check_contact(contacts[0], body, collider);
        for (std::size_t i = sizeof(dContactGeom); i < memory.size(); ++i) REQUIRE(memory[i] == kUntouched);
      }
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "the contact array is unchanged when the geoms are apart") {
  const Geom body(snCreateEllipsoid(nullptr, 1, 2, 3));
  place(body, {10, 0, 0});
  for (const ColliderGeom& collider : make_colliders_at({12, 3, 0})) {
    if (dGeomGetClass(collider) == dPlaneClass) dGeomPlaneSetParams(collider, 0, 0, 1, -4);
    std::vector<unsigned char> memory(sizeof(dContactGeom), 0x5A);
    const auto before = memory;
    CHECK(dCollide(body, collider, 1, reinterpret_cast<dContactGeom*>(memory.data()), sizeof(dContactGeom)) == 0);
    CHECK(memory == before);
  }
}

TEST_CASE_FIXTURE(OdeSession, "geoms of one body do not collide, nor does a geom with itself") {
  const World world;
  const dBodyID body = dBodyCreate(world.id());
  {
    const Geom one(snCreateEllipsoid(nullptr, 1, 1, 1));
    const Geom two(snCreateEllipsoid(nullptr, 1, 1, 1));
    dGeomSetBody(one, body);
    CHECK(collide(one, two).size() == 1);
    CHECK(collide(one, one).empty());
    dGeomSetBody(two, body);
    CHECK(collide(one, two).empty());
  }
}

TEST_CASE_FIXTURE(OdeSession, "a geom whose pose is not finite gives no contact and does not stop a space") {
  const dReal nan = std::numeric_limits<dReal>::quiet_NaN();
  const dSpaceID space = dHashSpaceCreate(nullptr);
  const dGeomID broken = snCreateEllipsoid(space, 1, 1, 1);
  const dGeomID whole = snCreateSuperellipsoid(space, 1, 1, 1, 3, 3);
  dGeomSetPosition(broken, nan, nan, nan);
  {
    const auto colliders = make_colliders_at({0, 0, 0});
    for (const ColliderGeom& collider : colliders) {
      check_no_contact(broken, collider);
      check_no_contact(collider, broken);
      if (dGeomGetClass(collider) == dPlaneClass) continue;
      CHECK(collide(whole, collider).size() == 1);
      dGeomSetPosition(collider, nan, nan, nan);
      check_no_contact(whole, collider);
      check_no_contact(collider, whole);
    }
  }
  const dGeomID plane = dCreatePlane(space, 0, 0, 1, 0);
  int pairs = 0;
  dSpaceCollide(space, &pairs, [](void* count, dGeomID, dGeomID) { ++*static_cast<int*>(count); });
  CHECK(pairs > 0);
  dGeomDestroy(plane);
  dSpaceDestroy(space);
}

TEST_CASE_FIXTURE(OdeSession, "the depth of points is right at the centre, on the surface and in between") {
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

TEST_CASE_FIXTURE(OdeSession,
                  "a block of triangles: moved out by 0.96 of the depth a body still touches, and by another 0.08 it is apart") {
  Random random(43);
  int touching = 0;
  for (int i = 0; i < kRepetitions; ++i) {
    CAPTURE(i);
    const Geom body(draw_body(random));
    const MeshGeom block(box_mesh({random.uniform(0.2, 1), random.uniform(0.2, 1), random.uniform(0.2, 1)}));
    random.turn(block);
    overlap(body, block, random.uniform(0, 0.3) * size_of(body), random);
    touching += check_separation(body, block, i % 2 == 0);
  }
  CHECK(touching > 0.98 * kRepetitions);
}

TEST_CASE_FIXTURE(OdeSession,
                  "a domed heightfield: moved out by 0.96 of the depth a body still touches, and by another 0.08 it is apart") {
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
