// Bodies against dHeightfield: planes, peaks and rough ground, with every kind of data and pose.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/terrain.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/polytope.hpp"

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

snProximity proximity_of(dGeomID g1, dGeomID g2) {
  snProximity answer{};
  REQUIRE(snGeomProximity(g1, g2, &answer) == 1);
  return answer;
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

// The nearest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Vector3 nearest_on(const MeshTriangle& triangle, const Vector3& p) {
  const auto& [a, b, c] = triangle.vertices;
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  return a + vb / (va + vb + vc) * ab + vc / (va + vb + vc) * ac;
}

Vector3 nearest_on(const std::vector<MeshTriangle>& triangles, const Vector3& p) {
  Vector3 nearest = Vector3::Constant(std::numeric_limits<double>::infinity());
  for (const MeshTriangle& triangle : triangles) {
    const Vector3 candidate = nearest_on(triangle, p);
    if ((candidate - p).norm() < (nearest - p).norm()) nearest = candidate;
  }
  return nearest;
}

}  // namespace

TEST_CASE("a level heightfield gives the contacts of a plane") {
  const OdeSession session;
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

TEST_CASE("a sloped heightfield gives the contacts of a plane, before and after its grid is known") {
  const OdeSession session;
  Random random(42);
  for (const bool is_bumpy : {false, true}) {
    CAPTURE(is_bumpy);
    const Terrain terrain({33, 33, 32, 32},
                          [&](int i, int j) { return 0.375 * i - 0.25 * j + (is_bumpy && i < 3 ? 0.1 * (i + j) : 0); });
    const Geom heightfield(terrain.create());
    const Geom visitor(snCreateEllipsoid(nullptr, 2, 2, 2));
    place(visitor, {-14, terrain.surface(-14, 0), 0.5});
    REQUIRE(!collide(visitor, heightfield).empty());
    const double length = std::sqrt(1 + 0.375 * 0.375 + 0.25 * 0.25);
    const Vec up = {-0.375 / length, 1 / length, 0.25 / length};
    const Geom plane(dCreatePlane(nullptr, dReal(up[0]), dReal(up[1]), dReal(up[2]), dReal(up[1] * terrain.surface(0, 0))));
    for (int k = 0; k < 200; ++k) {
      CAPTURE(k);
      const Geom body(random_body(random));
      const double x = random.uniform(-8, 12);
      const double z = random.uniform(-12, 12);
      place(body, {x, terrain.surface(x, z) + random.uniform(-0.2, 1.6), z});
      check_same(collide(body, heightfield), collide(body, plane), 1e-12);
    }
  }
}

TEST_CASE("a sphere on rough ground is as far as its centre from the nearest triangle") {
  const OdeSession session;
  Random random(43);
  for (const Source source : {Source::Double, Source::Callback, Source::Short}) {
    for (const bool repeats : {false, true}) {
      CAPTURE(repeats);
      const Terrain terrain({11, 9, 10, 9.6, repeats, source, 0.02, -0.5}, rough(44, 50));
      const Geom heightfield(terrain.create(true));
      for (int k = 0; k < 150; ++k) {
        CAPTURE(k);
        random.turn(heightfield);
        place(heightfield, 100 * random.direction());
        const Pose frame = pose_of(heightfield);
        const double radius = std::pow(10, random.uniform(-1.3, 0.3));
        const Geom body(snCreateEllipsoid(nullptr, dReal(radius), dReal(radius), dReal(radius)));
        const double x = random.uniform(-2, 2);
        const double z = random.uniform(-2, 2);
        const Vector3 centre{x, terrain.surface(x, z) + radius * random.uniform(0.1, 2), z};
        const Vector3 world = frame.rotation * centre + frame.position;
        place(body, {world.x(), world.y(), world.z()});
        random.turn(body);

        const Vector3 to_ground = nearest_on(all_triangles(terrain, {}, 0, 10, 8), centre) - centre;
        const double gap = to_ground.norm() - radius;
        const Vector3 normal = frame.rotation * to_ground.normalized();
        // The deeper it is, the farther the planes of the ground extend below one another.
        const bool is_shallow = gap > -0.1 * radius;
        if (is_shallow) {
          const snProximity proximity = proximity_of(body, heightfield);
          CHECK(std::abs(proximity.gap - gap) < within_rounding(1e-9 * radius, 4));
          CHECK((to_vector(proximity.normal) - normal).norm() < within_rounding(1e-5, 20));
        }
        const Contacts contacts = collide(body, heightfield, 50);
        REQUIRE(contacts.empty() == (gap > 0));
        if (contacts.empty()) continue;
        if (is_shallow) CHECK(std::abs(contacts[0].depth + gap) < within_rounding(1e-9 * radius, 4));
        CHECK(std::any_of(contacts.begin(), contacts.end(), [&](const dContactGeom& contact) {
          return std::abs(contact.depth + gap) < within_rounding(1e-9 * radius, 4) &&
                 (to_vector(contact.normal) + normal).norm() < within_rounding(1e-5, 20);
        }));
        for (const dContactGeom& contact : contacts) {
          CHECK(std::abs(norm(to_vec(contact.normal)) - 1) < within_rounding(1e-14));
          CHECK(contact.depth <= contacts[0].depth + 1e-15);
        }
      }
    }
  }
}

TEST_CASE("any body on rough ground has the contacts with all triangles") {
  const OdeSession session;
  Random random(45);
  const Terrain terrain({11, 9, 10, 9.6}, rough(46, 0.6));
  const Geom heightfield(terrain.create());
  const std::vector<MeshTriangle> triangles = all_triangles(terrain, {}, 0, 10, 8);
  MeshContacts reference;
  int count = 0;
  for (int k = 0; k < 400; ++k) {
    CAPTURE(k);
    const Geom body(random_body(random));
    const double x = random.uniform(-5.5, 5.5);  // also beyond the border
    const double z = random.uniform(-5.3, 5.3);
    place(body, {x, random.uniform(0.2, 1.9), z});
    const auto& shape = require_body(body).shape();
    const std::span<const MeshContact> expected = reference.find(shape, pose_of(body), triangles, {});
    const Contacts contacts = collide(body, heightfield, 100);
    REQUIRE(contacts.size() >= expected.size());
    // The manifold points of flat overlaps follow them.
    for (std::size_t i = expected.size(); i < contacts.size(); ++i) CHECK(contacts[i].depth <= contacts[0].depth);
    for (std::size_t i = 0; i < expected.size(); ++i, ++count) {
      const Proximity& proximity = expected[i].proximity;
      CHECK(std::abs(contacts[i].depth + proximity.gap) < within_rounding(1e-9, 4));
      CHECK((to_vector(contacts[i].normal) + proximity.normal).norm() < within_rounding(1e-6));
    }
    // The gap is the same from both functions.
    if (!contacts.empty()) CHECK(double{proximity_of(body, heightfield).gap} == -double{contacts[0].depth});
    if (contacts.empty()) {
      const Proximity nearest = find_nearest_triangle(shape, pose_of(body), triangles, {}).proximity;
      CHECK(std::abs(proximity_of(body, heightfield).gap - nearest.gap) < within_rounding(2e-9, 4));
    }
  }
  CHECK(count > 300);
}

TEST_CASE("the peak of a pyramid collides as the solid of the same shape") {
  const OdeSession session;
  Random random(47);
  const Terrain terrain({9, 9, 8, 8}, [](int i, int j) { return i == 4 && j == 4 ? 0.8 : 0.0; });
  const Geom heightfield(terrain.create());
  // The samples next to (4, 4) on the six triangles there.
  std::vector<Vector3> points = {{0, 0.8, 0}};
  for (const auto& [x, z] :
       {std::pair(1, 0), std::pair(0, 1), std::pair(-1, 1), std::pair(-1, 0), std::pair(0, -1), std::pair(1, -1)}) {
    points.emplace_back(x, 0, z);
    points.emplace_back(x, -3, z);
  }
  const Polytope pyramid(points);
  int touching = 0;
  for (int k = 0; k < 600; ++k) {
    CAPTURE(k);
    const auto a = dReal(random.uniform(0.05, 0.15));
    const auto b = dReal(random.uniform(0.05, 0.15));
    const auto c = dReal(random.uniform(0.05, 0.15));
    const Geom body(snCreateSuperellipsoid(nullptr, a, b, c, dReal(random.uniform(1.3, 8)), dReal(random.uniform(1.3, 8))));
    random.turn(body);
    const Vec side = random.direction();
    place(body, Vec{0, 0.8, 0} + random.uniform(0.03, 0.2) * Vec{side[0], std::abs(side[1]), side[2]});
    const Proximity expected = find_proximity(require_body(body).shape(), pose_of(body), pyramid, {});
    const snProximity found = proximity_of(body, heightfield);
    if (expected.gap > 0) {
      CHECK(std::abs(found.gap - expected.gap) < within_rounding(2e-10, 4));
      CHECK(collide(body, heightfield).empty());
    } else if (expected.gap > -0.01) {
      ++touching;
      CHECK(std::abs(found.gap - expected.gap) < within_rounding(2e-10, 4));
      const Contacts contacts = collide(body, heightfield);
      REQUIRE(!contacts.empty());
      CHECK(std::abs(contacts[0].depth + expected.gap) < within_rounding(2e-10, 4));
    }
  }
  CHECK(touching > 30);
}

TEST_CASE("a sunk body comes up") {
  const OdeSession session;
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

TEST_CASE("a heightfield in both orders, with any max_contacts and skip") {
  const OdeSession session;
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

TEST_CASE("a heightfield has the right gap from high above and from beside") {
  const OdeSession session;
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

TEST_CASE("a heightfield with values that are not finite gives no such contact and no abort") {
  const OdeSession session;
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

TEST_CASE("a body far smaller than the digits of its place is answered above a heightfield") {
  const OdeSession session;
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
