// Tests of the contacts with a surface of triangles that a body is about to meet.
#include "supernormal/contact/mesh_contacts_ahead.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"
#include "support/mesh_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kStep = 0.01;  // s

const Ellipsoid kBall(Vector3(0.05, 0.05, 0.05));

/// A floor z = 0 for x < 1 and a wall x = 1 above it.
std::vector<MeshTriangle> corner() {
  const Vector3 a(-3, -3, 0), b(1, -3, 0), c(1, 3, 0), d(-3, 3, 0), e(1, -3, 3), f(1, 3, 3);
  return {{{a, b, c}, 0}, {{a, c, d}, 1}, {{b, e, f}, 2}, {{b, f, c}, 3}};
}

BodyAhead flying(const Shape& shape, const Vector3& position, const Vector3& velocity) {
  return {shape,
          {position, Matrix3::Identity()},
          {.velocity = velocity, .centre = position, .turning = Matrix3::Identity() / 1e-3, .mobility = 1}};
}

/// Whether a face, a convex edge or a vertex of the surface has this outward normal: nothing at it rises above its plane. `inside`
/// (m): farther out there are borders, which have many normals.
bool has_normal(const TriangleMesh& mesh, double inside, const Vector3& normal) {
  const auto height = [&](int vertex) { return normal.dot(mesh.vertices[static_cast<std::size_t>(vertex)]); };
  for (const std::array<int, 3>& face : mesh.triangles) {
    for (std::size_t side = 0; side < 3; ++side) {
      const int a = face[side], b = face[(side + 1) % 3];
      if (mesh.vertices[static_cast<std::size_t>(a)].head<2>().lpNorm<Eigen::Infinity>() > inside) continue;
      const double top = height(a);
      const bool is_edge = std::abs(height(b) - top) < 1e-7;
      if (is_edge && std::abs(height(face[(side + 2) % 3]) - top) < 1e-7) return true;
      const bool is_top = std::ranges::all_of(mesh.triangles, [&](const std::array<int, 3>& other) {
        const auto has = [&](int vertex) { return std::ranges::find(other, vertex) != other.end(); };
        if (!has(a) || (is_edge && !has(b))) return true;
        return std::ranges::all_of(other, [&](int vertex) { return height(vertex) < top + 1e-7; });
      });
      if (is_top) return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("a ball that hits the floor slides on into the wall behind") {
  MeshContactsAhead ahead;
  const std::vector<MeshTriangle> triangles = corner();
  // On a straight path it would pass below the floor, and below the wall.
  const BodyAhead ball = flying(kBall, Vector3(0, 0, 0.15), Vector3(200, 0, -50));
  const auto found = ahead.find(ball, {}, kStep, triangles);
  REQUIRE(found.size() == 2);
  CHECK((found[0].manifold.deepest.normal + Vector3::UnitZ()).norm() < 1e-6);
  CHECK(found[0].manifold.deepest.gap == doctest::Approx(0.1));
  CHECK(found[0].triangle < 2);
  CHECK((found[1].manifold.deepest.normal - Vector3::UnitX()).norm() < 1e-6);
  CHECK(found[1].manifold.deepest.gap == doctest::Approx(0.95));
  CHECK(found[1].triangle >= 2);
}

TEST_CASE("a body behind the surface, moving away or too slow has no contact") {
  MeshContactsAhead ahead;
  const std::vector<MeshTriangle> triangles = corner();
  const auto has_contact = [&](const Vector3& position, const Vector3& velocity) {
    const auto found = ahead.find(flying(kBall, position, velocity), {}, kStep, triangles);
    return !found.empty() && found.front().manifold.deepest.gap <= found.front().manifold.reach;
  };
  CHECK(has_contact(Vector3(0, 0, 0.15), Vector3(0, 0, -50)));
  CHECK(!has_contact(Vector3(0, 0, 0.15), Vector3(0, 0, 50)));
  CHECK(!has_contact(Vector3(0, 0, 0.15), Vector3(0, 0, -5)));
  CHECK(!has_contact(Vector3(0, 0, -0.15), Vector3(0, 0, 5)));
}

TEST_CASE("a ball near the back or the border of a sheet has no contact with an overlap") {
  MeshContactsAhead ahead;
  const std::vector<MeshTriangle> sheet = {{{Vector3(-1, -1, 0), Vector3(0, -1, 0), Vector3(0, 1, 0)}, 0},
                                           {{Vector3(-1, -1, 0), Vector3(0, 1, 0), Vector3(-1, 1, 0)}, 1}};
  const auto least_gap = [&](const Vector3& position) {
    const auto found = ahead.find(flying(kBall, position, Vector3(0, 0.1, 0)), {}, kStep, sheet);
    return found.empty() ? 1 : found.front().manifold.deepest.gap;
  };
  const double apart = 0.05 + 5e-5;  // the swept body reaches ten times as far
  CHECK(least_gap(Vector3(-0.5, 0, -apart)) >= 0);
  for (int degrees = -90; degrees <= 90; degrees += 5) {
    const double angle = degrees * std::numbers::pi / 180;
    CAPTURE(degrees);
    CHECK(least_gap(apart * Vector3(std::cos(angle), 0, std::sin(angle))) >= 0);
  }
  // It has contacts in front of the sheet, and in an overlap.
  CHECK(least_gap(Vector3(-0.5, 0, apart)) == doctest::Approx(5e-5).epsilon(1e-6));
  CHECK(least_gap(Vector3(-0.5, 0, 0.0499)) == doctest::Approx(-1e-4).epsilon(1e-6));
}

TEST_CASE("contacts ahead with a moving surface use the relative velocity") {
  MeshContactsAhead ahead;
  const std::vector<MeshTriangle> triangles = corner();
  const MotionAhead surface{.velocity = Vector3(0, 0, 20)};
  const auto found = ahead.find(flying(kBall, Vector3(0, 0, 0.15), Vector3::Zero()), surface, kStep, triangles);
  REQUIRE(found.size() == 1);
  CHECK(found[0].manifold.deepest.gap == doctest::Approx(0.1));
}

TEST_CASE("all triangles that a body may meet are within the reach") {
  MeshContactsAhead ahead;
  const BodyAhead ball = flying(kBall, Vector3(0, 0, 0.15), Vector3(200, 0, -50));
  const MeshContactsAhead::Reach reach = MeshContactsAhead::reach_of(ball, {}, kStep);
  // Every place on the path, also on the path along the floor, is within the box.
  for (const Vector3& way : {Vector3(0, 0, 0), Vector3(0.4, 0, -0.1), Vector3(2, 0, -0.5), Vector3(2, 0, -0.1)}) {
    CHECK(((way - reach.middle).array().abs() <= reach.margin).all());
  }
}

TEST_CASE("a brick that lands on a sheet has four manifold points, none beyond the border") {
  const Superellipsoid brick({0.1, 0.07, 0.05}, 60, 60);
  MeshContactsAhead ahead;
  const std::vector<MeshTriangle> table = {{{Vector3(-1, -1, 0), Vector3(0, -1, 0), Vector3(0, 1, 0)}, 0},
                                           {{Vector3(-1, -1, 0), Vector3(0, 1, 0), Vector3(-1, 1, 0)}, 1}};
  for (const double gap : {3e-4, 0.0, -1e-5}) {
    const auto found = ahead.find(flying(brick, Vector3(-0.05, 0, 0.05 + gap), Vector3::Zero()), {}, kStep, table);
    REQUIRE(found.size() == 1);
    const ContactManifold& manifold = found[0].manifold;
    REQUIRE(manifold.corner_count == 4);
    double right = -1;
    for (const ManifoldCorner& corner : manifold.corners) {
      CHECK(corner.depth == doctest::Approx(-gap).epsilon(1e-6));
      right = std::max(right, corner.point.x());
    }
    CHECK(std::abs(right) < 1e-3);
  }
}

TEST_CASE("a body that moves towards the other side of a valley has the normals of both sides and no other") {
  // The edge between the sides is no edge of the surface, although each of its triangles has it.
  const Vector3 a(-5, -5, 0), b(-5, 5, 0), c(0, -5, 0), d(0, 5, 0), e(5, -5, 0.25), f(5, 5, 0.25);
  const std::vector<MeshTriangle> valley = {{{a, c, b}, 0}, {{b, c, d}, 1}, {{c, e, d}, 2}, {{d, e, f}, 3}};
  const Vector3 sides[] = {Vector3::UnitZ(), Vector3(-0.05, 0, 1).normalized()};
  const Ellipsoid pebble(Vector3(0.1, 0.1, 0.05));
  const Superellipsoid brick({0.1, 0.1, 0.05}, 60, 60);
  MeshContactsAhead ahead;
  Draw draw(55);
  int of_far_side = 0;
  for (int i = 0; i < draws(3000); ++i) {
    CAPTURE(i);
    const Shape& body = i % 2 == 0 ? static_cast<const Shape&>(pebble) : brick;
    // Up to 2 mm deep in the floor, where the body overlaps the triangles of the other side by their edge first.
    const Vector3 velocity = draw.in_box({3, 3, 0.2});
    BodyAhead moving = flying(body, Vector3(draw.uniform(-0.3, 0), 0.3, 0.05 + draw.uniform(-0.002, 0.002)), velocity);
    moving.motion.arm = body.bounding_radius();
    moving.pose.rotation = Eigen::AngleAxisd(draw.uniform(0, 6.28), Vector3::UnitZ()).toRotationMatrix();
    for (const MeshManifold& found : ahead.find(moving, {}, 0.02, valley)) {
      const Vector3 normal = -found.manifold.deepest.normal;
      CHECK(std::min((normal - sides[0]).norm(), (normal - sides[1]).norm()) < 1e-9);
      of_far_side += (normal - sides[1]).norm() < 1e-9 ? 1 : 0;
    }
  }
  CHECK(of_far_side > draws(300));
}

TEST_CASE("a ball over waves has contacts on its surface, at rest, sliding and rolling") {
  TriangleMesh waves = floor_mesh(20, 0.2);
  for (Vector3& vertex : waves.vertices) vertex.z() = 0.02 * std::sin(3.5 * vertex.x()) * std::cos(2.5 * vertex.y());
  const std::vector<MeshTriangle> triangles = waves.placed();
  const double radius = 0.1;
  const Ellipsoid ball(Vector3(radius, radius, radius));
  MeshContacts contacts;
  MeshContactsAhead ahead;
  Draw draw(56);
  for (int i = 0; i < draws(3000); ++i) {
    CAPTURE(i);
    Vector3 centre = draw.in_box({1, 1, 0}) + Vector3(0, 0, 0.3);
    for (int step = 0; step < 6; ++step)
      centre.z() -= find_nearest_triangle(ball, {centre, Matrix3::Identity()}, triangles).proximity.gap;
    centre.z() += draw.uniform(-5e-4, 5e-4);
    const double heading = draw.uniform(0, 6.28);
    BodyAhead moving =
        flying(ball, centre, i % 3 == 0 ? Vector3::Zero() : Vector3(3 * std::cos(heading), 3 * std::sin(heading), 0));
    moving.motion.arm = radius;
    if (i % 3 == 1) moving.motion.angular_velocity = Vector3::UnitZ().cross(moving.motion.velocity) / radius;
    for (const MeshContact& found : contacts.find(ball, moving.pose, triangles)) {
      CHECK(std::abs((found.proximity.contact - centre).norm() - radius) < 1e-6 * radius);
    }
    for (const MeshManifold& found : ahead.find(moving, {}, 0.02, triangles)) {
      const Proximity& contact = found.manifold.deepest;
      CHECK((contact.contact - (centre + radius * contact.normal)).norm() < 1e-6 * radius);
    }
  }
}

TEST_CASE("places of contacts are on the body, also where they move to limit its rotation") {
  const std::vector<MeshTriangle> floor = floor_mesh(4, 0.2).placed();
  const Vector3 half_axes(0.01, 0.007, 0.005);
  const Ellipsoid body(half_axes);
  MeshContactsAhead ahead;
  Draw draw(57);
  int moved = 0;
  for (int i = 0; i < draws(300); ++i) {
    CAPTURE(i);
    BodyAhead there = flying(body, draw.in_box({0.1, 0.1, 0}), Vector3::Zero());
    there.pose.rotation = draw.rotation();
    there.pose.position.z() = body.support(there.pose.rotation.transpose() * -Vector3::UnitZ());
    there.motion.centre = there.pose.position;
    there.motion.turning = Matrix3::Identity() / 2e-5;
    if (i % 2 == 0) there.motion.velocity = Vector3(draw.uniform(-0.2, 0.2), draw.uniform(-0.2, 0.2), 0);
    const double time = i % 3 == 0 ? 0.005 : 0.02;
    const bool hits = i % 4 == 1;
    if (hits) {
      there.motion.velocity = Vector3(draw.uniform(-4, 4), draw.uniform(-4, 4), -draw.uniform(1, 10));
      there.pose.position.z() -= draw.uniform(0, 1) * time * there.motion.velocity.z();
      there.motion.centre = there.pose.position;
    }
    there.motion.acceleration = Vector3(0, 0, -9.81);
    const auto found = ahead.find(there, {}, time, floor);
    REQUIRE(!found.empty());
    for (const MeshManifold& contact : found) {
      const Vector3 place = contact.manifold.deepest.contact;
      const Vector3 in_body = there.pose.rotation.transpose() * (place - there.pose.position);
      CHECK(in_body.cwiseQuotient(half_axes).norm() == doctest::Approx(1).epsilon(1e-6));
      moved += !hits && place.z() > 1e-4 ? 1 : 0;
    }
  }
  CHECK(moved > draws(30));
}

TEST_CASE("manifold points at the border of a mesh are on the body") {
  const std::vector<MeshTriangle> floor = floor_mesh(4, 0.2).placed();
  const Superellipsoid body({0.1, 0.08, 0.05}, 8, 8);
  MeshContactsAhead ahead;
  Draw draw(58);
  int points = 0;
  for (int i = 0; i < draws(100); ++i) {
    CAPTURE(i);
    const Vector3 velocity(draw.uniform(-1, 1), draw.uniform(-1, 1), -draw.log_uniform(0.01, 10));
    BodyAhead there = flying(body, draw.in_box({0.5, 0.5, 0}), velocity);
    const Matrix3 turn = Eigen::AngleAxisd(draw.uniform(0, 6), Vector3::UnitZ()).toRotationMatrix();
    there.pose.rotation = Eigen::AngleAxisd(draw.log_uniform(1e-6, 0.1), draw.direction()).toRotationMatrix() * turn;
    const double lowest = body.support(there.pose.rotation.transpose() * -Vector3::UnitZ());
    there.pose.position.z() = lowest - draw.uniform(0, 1) * 0.01 * velocity.z();
    there.motion.centre = there.pose.position;
    there.motion.turning = Matrix3::Identity() / 2e-3;
    for (const MeshManifold& contact : ahead.find(there, {}, 0.01, floor)) {
      for (int k = 0; k < contact.manifold.corner_count; ++k) {
        const ManifoldCorner& corner = contact.manifold.corners[static_cast<std::size_t>(k)];
        const double off = find_proximity(body, there.pose, Sphere(0), {corner.point, Matrix3::Identity()}).gap;
        CHECK(std::abs(off) < std::max(0.0, corner.depth) + 1e-8);
        ++points;
      }
    }
  }
  CHECK(points > draws(100));
}

TEST_CASE("a ball beside a tile has the tile's normal, on its surface, and rolls on over the border") {
  const std::vector<MeshTriangle> tile = {{{Vector3(-1, -1, 0), Vector3(0, -1, 0), Vector3(0, 1, 0)}, 0},
                                          {{Vector3(-1, -1, 0), Vector3(0, 1, 0), Vector3(-1, 1, 0)}, 1}};
  constexpr double kRadius = 0.01;
  constexpr double kLong = 0.02;  // s; the ball would fall by 0.4 radii
  const Ellipsoid ball(Vector3(kRadius, kRadius, kRadius));
  MeshContactsAhead ahead;
  Draw draw(58);
  for (int i = 0; i < draws(1000); ++i) {
    CAPTURE(i);
    // The next tile bears the ball.
    const Vector3 centre(draw.uniform(0, 0.5) * kRadius, draw.uniform(-0.9, 0.9), kRadius);
    const double heading = draw.uniform(0, 6.28);
    BodyAhead rolling =
        flying(ball, centre, draw.uniform(0, 0.3) * kRadius / kLong * Vector3(std::cos(heading), std::sin(heading), 0));
    rolling.motion.arm = kRadius;
    if (i % 2 == 0) rolling.motion.angular_velocity = Vector3::UnitZ().cross(rolling.motion.velocity) / kRadius;
    rolling.motion.acceleration = Vector3(0, 0, -9.81);
    for (const MeshManifold& found : ahead.find(rolling, {}, kLong, tile)) {
      const Proximity& contact = found.manifold.deepest;
      const Vector3 arm = contact.contact - centre;
      CHECK((contact.normal + Vector3::UnitZ()).norm() < 1e-9);
      CHECK(std::abs(arm.norm() - kRadius) < 1e-6 * kRadius);
      const Vector3 at_place = rolling.motion.velocity + rolling.motion.angular_velocity.cross(arm);
      CHECK(contact.normal.dot(at_place) * kLong <= contact.gap + 1e-9 * kRadius);
    }
  }
}

TEST_CASE("a body that would fall past the border of a sheet has no contact with its back") {
  const std::vector<MeshTriangle> tile = {{{Vector3(-1, -1, 0), Vector3(0, -1, 0), Vector3(0, 1, 0)}, 0},
                                          {{Vector3(-1, -1, 0), Vector3(0, 1, 0), Vector3(-1, 1, 0)}, 1}};
  const Ellipsoid ball(Vector3(0.001, 0.001, 0.001));
  MeshContactsAhead ahead;
  for (const double beyond : {0.0015, 0.005, 0.01}) {
    BodyAhead falling = flying(ball, Vector3(beyond, 0, 0.001), Vector3::Zero());
    falling.motion.acceleration = Vector3(0, 0, -9.81);
    for (const MeshManifold& found : ahead.find(falling, {}, 0.05, tile)) CHECK(found.manifold.deepest.normal.z() <= 0);
  }
}

TEST_CASE("a body that rolls over rough ground has normals of its faces, edges and vertices alone") {
  TriangleMesh ground = floor_mesh(12, 0.13);
  Draw draw(57);
  for (Vector3& vertex : ground.vertices) vertex.z() = draw.uniform(0, 0.06);
  const std::vector<MeshTriangle> triangles = ground.placed();
  const Superellipsoid brick({0.1, 0.08, 0.05}, 20, 20);
  MeshContactsAhead ahead;
  for (int i = 0; i < draws(800); ++i) {
    CAPTURE(i);
    Vector3 centre = draw.in_box({0.3, 0.3, 0}) + Vector3(0, 0, 0.3);
    const Matrix3 rotation = draw.rotation();
    for (int step = 0; step < 6; ++step) centre.z() -= find_nearest_triangle(brick, {centre, rotation}, triangles).proximity.gap;
    const double heading = draw.uniform(0, 6.28);
    BodyAhead rolling = flying(brick, centre, 2 * Vector3(std::cos(heading), std::sin(heading), 0));
    rolling.pose.rotation = rotation;
    rolling.motion.arm = brick.bounding_radius();
    rolling.motion.angular_velocity = Vector3::UnitZ().cross(rolling.motion.velocity) / 0.1;
    rolling.motion.acceleration = Vector3(0, 0, -9.81);
    for (const MeshManifold& found : ahead.find(rolling, {}, 0.02, triangles)) {
      const ContactManifold& manifold = found.manifold;
      CHECK((manifold.deepest.gap > manifold.reach || has_normal(ground, 0.7, -manifold.deepest.normal)));
    }
  }
}
