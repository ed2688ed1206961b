// Bodies against dHeightfield: planes, peaks and rough ground, with every kind of data and pose.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/terrain.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "support/ode_world.hpp"

using namespace supernormal;
using namespace supernormal::test;
using supernormal::ode::pose_of;
using supernormal::ode::require_body;
using supernormal::ode::to_vector;

namespace {

using Contacts = std::vector<dContactGeom>;

void check_same(const Contacts& ours, const Contacts& reference, double in_double) {
  const double tolerance = within_rounding(in_double, 10);
  REQUIRE(ours.size() == reference.size());
  for (std::size_t k = 0; k < ours.size(); ++k) {
    CHECK(std::abs(ours[k].depth - reference[k].depth) < tolerance);
    CHECK(norm(to_vec(ours[k].normal) - to_vec(reference[k].normal)) < tolerance);
    CHECK(norm(to_vec(ours[k].pos) - to_vec(reference[k].pos)) < tolerance);
  }
}

void stand_up(dGeomID heightfield) {
  dMatrix3 R;
  dRFromAxisAndAngle(R, 1, 0, 0, dReal(0.5 * std::acos(-1.0)));
  dGeomSetRotation(heightfield, R);
}

/// All triangles of the samples from i_low to i_high in the world, without the code that finds the grid.
std::vector<MeshTriangle> all_triangles(const Terrain& terrain, const Pose& pose, int low, int high_x, int high_z) {
  const auto vertex = [&](int i, int j) {
    const Vec v = terrain.vertex(i, j);
    return Vector3(pose.rotation * Vector3(v[0], v[1], v[2]) + pose.position);
  };
  std::vector<MeshTriangle> triangles;
  for (int i = low; i < high_x; ++i) {
    for (int j = low; j < high_z; ++j) {
      triangles.push_back({{vertex(i, j), vertex(i, j + 1), vertex(i + 1, j)}, 0});
      triangles.push_back({{vertex(i + 1, j + 1), vertex(i + 1, j), vertex(i, j + 1)}, 0});
    }
  }
  return triangles;
}

/// Sets up a rough world in which y is up.
void set_up(World& world) {
  dWorldSetGravity(world.id(), 0, dReal(-kGravity), 0);
  world.set_friction(0.5);
}

dBodyID add(const World& world, dGeomID geom) {
  dMass mass;
  dMassSetSphereTotal(&mass, 1, dReal(0.1));  // the same mass for a dSphere
  return world.add(geom, mass);
}

/// The smallest height of the body's middle above the surface while it falls from `start` for two seconds, as long as it is over
/// the heightfield.
double lowest_height(dGeomID (*create)(dSpaceID space), const Terrain& terrain, const Vec& start) {
  World world;
  set_up(world);
  terrain.create(false, world.space());
  const dBodyID body = add(world, create(world.space()));
  dBodySetPosition(body, dReal(start[0]), dReal(start[1]), dReal(start[2]));
  double lowest = start[1];
  for (int step = 0; step < 1000; ++step) {
    world.quick_step(0.002);
    const Vec p = to_vec(dBodyGetPosition(body));
    if (std::abs(p[0]) > 0.49 * terrain.layout().width || std::abs(p[2]) > 0.49 * terrain.layout().depth) break;
    lowest = std::min(lowest, p[1] - terrain.surface(p[0], p[2]));
  }
  return lowest;
}

dGeomID create_ode_sphere(dSpaceID space) { return dCreateSphere(space, dReal(0.1)); }
dGeomID create_our_sphere(dSpaceID space) { return snCreateEllipsoid(space, dReal(0.1), dReal(0.1), dReal(0.1)); }
dGeomID create_brick(dSpaceID space) { return snCreateSuperellipsoid(space, dReal(0.1), dReal(0.07), dReal(0.05), 8, 8); }
dGeomID create_egg(dSpaceID space) { return snCreateEllipsoid(space, dReal(0.08), dReal(0.1), dReal(0.05)); }

}  // namespace

TEST_CASE_FIXTURE(OdeSession, "a level heightfield gives the contacts of a plane") {
  Random random(41);
  for (const bool repeats : {false, true}) {
    const Terrain terrain({33, 33, 32, 32, repeats}, [](int, int) { return 0.25; });
    const Geom heightfield(terrain.create(true));
    for (int k = 0; k < 300; ++k) {
      CAPTURE(k);
      const Geom body(random_body(random));
      random.turn(heightfield);
      place(heightfield, 5 * random.direction());
      const Pose frame = pose_of(heightfield);
      const Vector3 up = frame.rotation.col(1);
      const Geom plane(dCreatePlane(nullptr, dReal(up.x()), dReal(up.y()), dReal(up.z()), dReal(up.dot(frame.position) + 0.25)));
      // The body is anywhere, above a line of the grid or above a sample, from below the surface to above it.
      Vector3 where{random.uniform(-10, 10), 0.25 + random.uniform(-0.3, 1.6), random.uniform(-10, 10)};
      if (k % 3 > 0) where.x() = std::round(where.x());
      if (k % 3 > 1) where.z() = std::round(where.z());
      const Vector3 world = frame.rotation * where + frame.position;
      place(body, {world.x(), world.y(), world.z()});
      check_same(collide(body, heightfield), collide(body, plane), 1e-12);
      check_same(collide(heightfield, body), collide(plane, body), 1e-12);
      const snProximity ours = proximity_of(body, heightfield);
      const snProximity theirs = proximity_of(body, plane);
      CHECK(std::abs(ours.gap - theirs.gap) < within_rounding(theirs.gap > 0 ? 1e-9 : 1e-12, 4));
    }
  }
}

TEST_CASE_FIXTURE(OdeSession,
                  "any body on rough ground has the contacts with all triangles, from every source, repeated, rotated and moved") {
  Random random(45);
  MeshContacts reference;
  int count = 0;
  for (const Source source : {Source::Double, Source::Callback, Source::Short}) {
    for (const bool repeats : {false, true}) {
      CAPTURE(static_cast<int>(source));
      CAPTURE(repeats);
      const Terrain terrain({11, 9, 10, 9.6, repeats, source, 0.02, -0.5}, rough(46, 30));
      const Geom heightfield(terrain.create(true));
      random.turn(heightfield);
      place(heightfield, 100 * random.direction());
      const std::vector<MeshTriangle> triangles = all_triangles(terrain, pose_of(heightfield), 0, 10, 8);
      for (int k = 0; k < 100; ++k) {
        CAPTURE(k);
        const Geom body(random_body(random));
        const double share = repeats ? 0.3 : 1;  // also beyond the border of one that does not repeat
        dVector3 where;
        dGeomGetRelPointPos(heightfield, dReal(share * random.uniform(-5.5, 5.5)), dReal(random.uniform(-0.3, 1.4)),
                            dReal(share * random.uniform(-5.3, 5.3)), where);
        place(body, to_vec(where));
        const auto& shape = require_body(body).shape();
        const std::span<const MeshContact> expected = reference.find(shape, pose_of(body), triangles, {});
        const Contacts contacts = collide(body, heightfield, 100);
        REQUIRE(contacts.size() >= expected.size());
        // The manifold points of flat overlaps follow them.
        for (std::size_t i = expected.size(); i < contacts.size(); ++i) CHECK(contacts[i].depth <= contacts[0].depth);
        for (std::size_t i = 0; i < expected.size(); ++i, ++count) {
          const Proximity& proximity = expected[i].proximity;
          CHECK(std::abs(contacts[i].depth + proximity.gap) < within_rounding(1e-9, 100));
          CHECK((to_vector(contacts[i].normal) + proximity.normal).norm() < within_rounding(1e-6, 100));
        }
        // The gap is the same from both functions.
        const double gap = proximity_of(body, heightfield).gap;
        if (!contacts.empty()) CHECK(gap == -double{contacts[0].depth});
        if (contacts.empty()) {
          const Proximity nearest = find_nearest_triangle(shape, pose_of(body), triangles, {}).proximity;
          CHECK(std::abs(gap - nearest.gap) < within_rounding(2e-9, 100));
        }
      }
    }
  }
  CHECK(count > 300);
}

TEST_CASE_FIXTURE(OdeSession, "a sunk body comes up") {
  Random random(48);
  const Terrain terrain({11, 11, 10, 10}, rough(49, 0.5));
  const Geom heightfield(terrain.create(true));
  stand_up(heightfield);  // z is up: (x, y, z) of the heightfield is (x, -z, y) of the world
  for (int k = 0; k < 300; ++k) {
    CAPTURE(k);
    const Geom body(random_body(random));
    const double x = random.uniform(-3, 3);
    const double z = random.uniform(-3, 3);
    place(body, {x, -z, terrain.surface(x, z) - random.uniform(0, 3)});
    const Contacts contacts = collide(body, heightfield);
    REQUIRE(!contacts.empty());
    Vec push{};
    for (const dContactGeom& contact : contacts) push = push + double{contact.depth} * to_vec(contact.normal);
    CHECK(push[2] > 0);
    CHECK(proximity_of(body, heightfield).gap < 0);
  }
}

TEST_CASE_FIXTURE(OdeSession, "a heightfield in both orders, with any max_contacts and skip") {
  Random random(50);
  const Terrain terrain({21, 21, 4, 4}, rough(51, 0.2));
  const Geom heightfield(terrain.create());
  const Geom body(snCreateEllipsoid(nullptr, 1, 1, dReal(0.6)));
  place(body, {0.1, 0.6, 0.2});
  random.turn(body);
  const Contacts all = collide(body, heightfield, 100);
  REQUIRE(all.size() > 3);
  for (int room = 1; room <= 4; ++room) {
    std::vector<dContact> contacts(5);
    for (dContact& contact : contacts) contact.surface.mu = 77;
    const int count = dCollide(heightfield, body, room, &contacts[0].geom, sizeof(dContact));
    REQUIRE(count == room);
    for (int k = 0; k < 5; ++k) {
      const dContact& contact = contacts[static_cast<std::size_t>(k)];
      CHECK(contact.surface.mu == 77);
      if (k >= count) continue;
      const dContactGeom& expected = all[static_cast<std::size_t>(k)];
      CHECK(contact.geom.depth == expected.depth);
      CHECK(norm(to_vec(contact.geom.normal) + to_vec(expected.normal)) == 0);
      CHECK(contact.geom.g1 == heightfield);
      CHECK(contact.geom.g2 == body);
      CHECK(contact.geom.side1 == -1);
    }
  }
  const snProximity forward = proximity_of(body, heightfield);
  const snProximity backward = proximity_of(heightfield, body);
  CHECK(forward.gap == backward.gap);
  CHECK(norm(to_vec(forward.normal) + to_vec(backward.normal)) == 0);
}

TEST_CASE_FIXTURE(OdeSession, "a heightfield has the right gap from high above and from beside") {
  Random random(52);
  const Terrain terrain({9, 9, 8, 8}, rough(53, 1));
  const Geom heightfield(terrain.create());
  const std::vector<MeshTriangle> triangles = all_triangles(terrain, {}, 0, 8, 8);
  for (int k = 0; k < 60; ++k) {
    CAPTURE(k);
    const Geom body(random_body(random));
    const Vec where = random.uniform(8, 40) * random.direction();
    place(body, {where[0], std::abs(where[1]), where[2]});
    const Proximity nearest = find_nearest_triangle(require_body(body).shape(), pose_of(body), triangles, {}).proximity;
    const snProximity proximity = proximity_of(body, heightfield);
    CHECK(proximity.gap > 0);
    CHECK(std::abs(proximity.gap - nearest.gap) < within_rounding(2e-9, 4));
    CHECK(collide(body, heightfield).empty());
  }
}

TEST_CASE_FIXTURE(OdeSession, "a heightfield with values that are not finite gives no such contact and no abort") {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Geom body(snCreateEllipsoid(nullptr, dReal(0.5), dReal(0.4), dReal(0.3)));
  for (const Source source : {Source::Double, Source::Callback}) {
    Terrain terrain({9, 9, 8, 8, false, source}, rough(54, 1));
    for (const auto& [i, j] : {std::pair(4, 4), std::pair(0, 0), std::pair(8, 3)}) terrain.set(i, j, kNan);
    const Geom heightfield(terrain.create());
    Random random(55);
    for (int k = 0; k < 300; ++k) {
      place(body, {random.uniform(-4.5, 4.5), random.uniform(-0.5, 1.5), random.uniform(-4.5, 4.5)});
      for (const dContactGeom& contact : collide(body, heightfield)) {
        CHECK(std::isfinite(contact.depth + contact.pos[0] + contact.pos[1] + contact.pos[2]));
        CHECK(std::abs(norm(to_vec(contact.normal)) - 1) < within_rounding(1e-12));
      }
    }
    terrain.build({5, 5, 8, 8, true, source}, [](int, int) { return kNan; });
    place(body, {0, 0, 0});
    CHECK(collide(body, heightfield).empty());
  }
  // The body is on the border to the last digit, where a ray would abort in ODE.
  const Terrain terrain({9, 9, 8, 8}, rough(54, 1));
  const Geom heightfield(terrain.create());
  for (const double x : {4.0, std::nextafter(4.0, 5.0), std::nextafter(4.0, 3.0), 4.5, 4.0 + 1e-12}) {
    for (const double z : {-4.0, 4.0, std::nextafter(4.0, 3.0), 4.4999}) {
      place(body, {x, 0.5, z});
      collide(body, heightfield);
      snProximity proximity;
      CHECK(snGeomProximity(body, heightfield, &proximity) == 1);
    }
  }
  const Terrain endless({5, 5, 8, 8, true}, rough(56, 1));
  const Geom far(endless.create());
  for (const double x : {1e5, -1e7, 1e12, 1e30}) {
    place(body, {x, 0.2, -x});
    collide(body, far);
  }
  place(body, {1e12, 0.2, 0});
  CHECK(collide(body, far).empty());
  CHECK(std::string(snLastError()).find("infinite dHeightfield") != std::string::npos);
}

TEST_CASE_FIXTURE(OdeSession, "a body far smaller than the digits of its place is answered above a heightfield") {
  const Terrain terrain(Terrain::Layout{}, [](int i, int j) { return 0.1 * (i % 2) + 0.05 * (j % 3); });
  const Geom field(dCreateHeightfield(nullptr, terrain.data(), 0));
  for (const double size : {1e-30, 1e-20, 1e-9, 1e-3}) {
    const Geom grain(snCreateEllipsoid(nullptr, dReal(size), dReal(size), dReal(size)));
    const Geom probe(snCreateEllipsoid(nullptr, dReal(1e-3), dReal(1e-3), dReal(1e-3)));
    for (const double x : {0.0, 1.3, -2.7}) {
      CAPTURE(size);
      CAPTURE(x);
      snProximity answer, known;
      place(grain, {x, 0.5, x / 3});
      place(probe, {x, 0.5, x / 3});
      REQUIRE(snGeomProximity(grain, field, &answer) == 1);
      REQUIRE(snGeomProximity(probe, field, &known) == 1);
      CHECK(std::abs((double{answer.gap} + size) - (double{known.gap} + 1e-3)) < 1e-6);
      place(grain, {x, -0.5, x / 3});
      CHECK(collide(grain, field).size() == 1);
    }
  }
}

TEST_CASE_FIXTURE(OdeSession, "small bodies dropped on ridges and peaks stay above, where dSphere does not") {
  const Terrain ridge({9, 9, 8, 8}, [](int i, int /*j*/) { return 2.0 - 0.8 * std::abs(i - 4); });
  const Terrain peak({9, 9, 8, 8}, [](int i, int j) { return i == 4 && j == 4 ? 1.5 : 0.0; });
  const Terrain diagonal({9, 9, 8, 8}, [](int i, int j) { return -0.7 * std::abs(i + j - 8); });
  struct Case {
    const Terrain& terrain;
    Vec top;
  };
  const std::array<Case, 3> cases = {{{ridge, {0, 2, 0.3}}, {peak, {0, 1.5, 0}}, {diagonal, {0.5, 0, -0.5}}}};
  for (const Case& c : cases) {
    const Vec start = c.top + Vec{0, 0.4, 0};
    CHECK(lowest_height(create_ode_sphere, c.terrain, start) < -0.5);
    CHECK(lowest_height(create_our_sphere, c.terrain, start) > 0.09);
    CHECK(lowest_height(create_brick, c.terrain, start) > 0.045);
    CHECK(lowest_height(create_egg, c.terrain, start) > 0.045);
    for (const double aside : {1e-9, 0.01, 0.03, -0.05}) {
      CAPTURE(aside);
      CHECK(lowest_height(create_our_sphere, c.terrain, start + Vec{aside, 0, 0.3 * aside}) > 0.09);
    }
  }
}
