// Tests of contacts that are found before the bodies overlap.
#include "supernormal/contact/contacts_ahead.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

using namespace supernormal;

namespace {

constexpr double kTime = 0.01;  // s

/// A body of mass 1 that moves without rotation.
BodyAhead moving(const Shape& shape, const Pose& pose, const Vector3& velocity) {
  const double size = shape.half_extents().minCoeff();
  return {shape,
          pose,
          {.velocity = velocity, .centre = pose.position, .turning = Matrix3::Identity() / (0.4 * size * size), .mobility = 1}};
}

BodyAhead standing(const Shape& shape, const Pose& pose) { return {shape, pose, {.centre = pose.position}}; }

ContactManifold find(const BodyAhead& body1, const BodyAhead& body2) {
  const Proximity now = find_proximity(body1.shape, body1.pose, body2.shape, body2.pose);
  return find_contacts_ahead(body1, body2, kTime, {}, now);
}

bool has_contact(const ContactManifold& manifold) {
  return manifold.deepest.status != Status::Apart && manifold.deepest.gap <= manifold.reach;
}

/// How much of the motion without contact forces the contacts of a body with a wall at rest take away, m.
double taken_away(const BodyAhead& body, const ContactManifold& manifold) {
  if (!has_contact(manifold)) return 0;
  double most = 0;
  const auto look_at = [&](const Vector3& place, double gap) {
    const Vector3 turning = body.motion.angular_velocity.cross(place - body.motion.centre);
    const Vector3 velocity = body.motion.velocity + turning + kTime * body.motion.acceleration;
    most = std::max(most, kTime * velocity.dot(manifold.deepest.normal) - gap);
  };
  if (manifold.corner_count == 0) look_at(manifold.deepest.contact, manifold.deepest.gap);
  for (int k = 0; k < manifold.corner_count; ++k) {
    const ManifoldCorner& corner = manifold.corners[static_cast<std::size_t>(k)];
    look_at(corner.point, -corner.depth);
  }
  return most;
}

/// The contacts with the half-space z <= 0.
ContactManifold find_on_plane(const BodyAhead& body) {
  return find_plane_contacts_ahead(body, kTime, find_plane_proximity(body.shape, body.pose, Vector3::UnitZ(), 0));
}

/// The distance of a point from the boundary of a body, m; negative inside.
double distance_from(const BodyAhead& body, const Vector3& point) {
  return find_proximity(body.shape, body.pose, Sphere(0), {point, Matrix3::Identity()}).gap;
}

}  // namespace

TEST_CASE("places of contacts with a plane, or a box at rest, are on the body that moves, also in impacts") {
  const Vector3 half_axes(0.01, 0.007, 0.005);
  const Ellipsoid body(half_axes);
  const Box box({1, 1, 0.5});
  const BodyAhead floor = standing(box, {Vector3(0, 0, -0.5), Matrix3::Identity()});
  test::Draw draw(60);
  for (int i = 0; i < test::draws(300); ++i) {
    CAPTURE(i);
    const Vector3 velocity(draw.uniform(-10, 10), draw.uniform(-10, 10), -draw.log_uniform(0.01, 30));
    const Matrix3 rotation = draw.rotation();
    const double height = body.support(rotation.transpose() * -Vector3::UnitZ());
    const BodyAhead there = moving(body, {Vector3(0, 0, height - draw.uniform(0, 1) * kTime * velocity.z()), rotation}, velocity);
    for (const ContactManifold& found : {find_on_plane(there), find(there, floor), find(floor, there)}) {
      REQUIRE(has_contact(found));
      const Vector3 in_body = rotation.transpose() * (found.deepest.contact - there.pose.position);
      CHECK(in_body.cwiseQuotient(half_axes).norm() == doctest::Approx(1).epsilon(1e-6));
    }
  }
}

TEST_CASE("manifold points are on the body that moves: of faces and lines, of any flatness, all, three or two of them") {
  const Box box({1, 1, 0.5});
  const BodyAhead floor = standing(box, {Vector3(0, 0, -0.5), Matrix3::Identity()});
  test::Draw draw(61);
  int points = 0;
  for (int i = 0; i < test::draws(300); ++i) {
    CAPTURE(i);
    const double exponent = std::array{5.0, 6.0, 8.0, 20.0, 60.0}[static_cast<std::size_t>(i % 5)];
    const bool is_can = i % 3 == 0;
    const Superellipsoid body({0.01, is_can ? 0.01 : 0.008, 0.005}, is_can ? 2 : exponent, exponent);
    const double tilt = i % 2 == 0 ? draw.log_uniform(1e-6, 0.02) : std::numbers::pi / 2;
    const Matrix3 rotation = Eigen::AngleAxisd(tilt, draw.direction()).toRotationMatrix();
    const double height = body.support(rotation.transpose() * -Vector3::UnitZ());
    const Vector3 velocity(draw.uniform(-2, 2), draw.uniform(-2, 2), i % 7 == 0 ? 0 : -draw.log_uniform(0.01, 10));
    const double above = draw.uniform(-1e-6, 1) * kTime * -velocity.z();
    const BodyAhead there = moving(body, {Vector3(0, 0, height + above), rotation}, velocity);
    for (const ContactManifold& found : {find_on_plane(there), find(there, floor), find(floor, there)}) {
      for (const int room : {2, 3, 4}) {
        const ContactManifold reduced = reduced_to(found, room);
        for (int k = 0; k < reduced.corner_count; ++k) {
          const ManifoldCorner& corner = reduced.corners[static_cast<std::size_t>(k)];
          CHECK(std::abs(distance_from(there, corner.point)) < std::max(0.0, corner.depth) + 1e-9);
          ++points;
        }
      }
    }
  }
  CHECK(points > test::draws(2000));
}

TEST_CASE("points beside the silhouette of a leaning can or brick that falls are on its silhouette") {
  const Box box({1, 1, 0.5});
  const Cylinder can(0.007, 0.01);
  const Box brick({0.01, 0.008, 0.005});
  const BodyAhead floor = standing(box, {Vector3(0, 0, -0.5), Matrix3::Identity()});
  test::Draw draw(62);
  for (int i = 0; i < test::draws(1000); ++i) {
    CAPTURE(i);
    const Shape& body = i % 2 == 0 ? static_cast<const Shape&>(can) : brick;
    const Matrix3 rotation = draw.rotation();
    const double height = body.support(rotation.transpose() * -Vector3::UnitZ());
    const BodyAhead there = moving(body, {Vector3(0, 0, height + 1e-4), rotation}, draw.uniform(0.1, 0.8) * Vector3(0.2, 0, -1));
    const ContactManifold found = reduced_to(find(there, floor), 4);
    for (int k = 0; k < found.corner_count; ++k) {
      CHECK(std::abs(distance_from(there, found.corners[static_cast<std::size_t>(k)].point)) < 1e-9);
    }
  }
}

TEST_CASE("a ball that flies at a wall has one contact on the ball, with the present gap and the wall's normal") {
  const Ellipsoid ball(Vector3(0.05, 0.05, 0.05));
  const Box wall(Vector3(1, 1, 0.01));
  for (const double speed : {1.0, 10.0, 1000.0}) {
    const double gap = 0.7 * speed * kTime;
    const BodyAhead body = moving(ball, {Vector3(0.1, 0.2, 0.06 + gap), Matrix3::Identity()}, Vector3(0, 0, -speed));
    const ContactManifold manifold = find(body, standing(wall, {}));
    REQUIRE(has_contact(manifold));
    CHECK(manifold.corner_count == 0);
    CHECK(manifold.deepest.gap == doctest::Approx(gap));
    CHECK((manifold.deepest.normal + Vector3::UnitZ()).norm() < 1e-9);
    CHECK((manifold.deepest.contact - Vector3(0.1, 0.2, 0.01 + gap)).norm() < 1e-6 * gap + 1e-9);
    // A ball that moves away, or is slower, has none.
    CHECK(!has_contact(find(moving(ball, body.pose, Vector3(0, 0, speed)), standing(wall, {}))));
    CHECK(!has_contact(find(moving(ball, body.pose, Vector3(0, 0, -0.5 * speed)), standing(wall, {}))));
  }
}

TEST_CASE("the normal of a contact ahead is the normal at the impact") {
  const Ellipsoid ball(Vector3(0.05, 0.05, 0.05));
  const Box wall(Vector3(0.5, 0.5, 0.5));
  // The nearest feature is the edge x = z = 0.5. The ball flies past it and meets the top.
  const BodyAhead body = moving(ball, {Vector3(1, 0, 0.7), Matrix3::Identity()}, Vector3(-90, 0, -16));
  const ContactManifold manifold = find(body, standing(wall, {}));
  REQUIRE(has_contact(manifold));
  CHECK((manifold.deepest.normal + Vector3::UnitZ()).norm() < 1e-6);
  CHECK(manifold.deepest.gap == doctest::Approx(0.15));
}

TEST_CASE("random pairs: no impact is missed, and a body that passes by has no contact") {
  test::Draw random(5);
  int impacts = 0;
  int passes = 0;
  for (int pair = 0; pair < test::draws(1500); ++pair) {
    const double exponents[] = {2, 3, 8, 60};
    const auto draw = [&] {
      const Vector3 half = random.within(0.02, 0.06);
      return Superellipsoid(half, exponents[static_cast<std::size_t>(random.whole(0, 3))],
                            exponents[static_cast<std::size_t>(random.whole(0, 3))]);
    };
    const Superellipsoid shape1 = draw();
    const Superellipsoid shape2 = draw();
    const double size = std::min(shape1.half_extents().minCoeff(), shape2.half_extents().minCoeff());
    const Pose pose1{Vector3(random.uniform(0.12, 0.4), random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15)),
                     random.rotation()};
    const Pose pose2{Vector3::Zero(), random.rotation()};
    const BodyAhead body1 = moving(shape1, pose1, Vector3(-random.uniform(1, 80), 0, 0));
    const BodyAhead body2 = moving(shape2, pose2, Vector3(0, random.uniform(-5, 5), 0));
    const ContactManifold manifold = find(body1, body2);
    const Pose far{pose1.position + 2 * Vector3::UnitX(), pose1.rotation};  // farther than they move in the step
    const Proximity away = find_proximity(shape1, far, shape2, pose2);
    CHECK(find_contacts_ahead(moving(shape1, far, body1.motion.velocity), body2, kTime, {}, away).deepest.evaluations ==
          away.evaluations);
    double least = std::numeric_limits<double>::infinity();
    double last = 0;
    double deep = kTime;  // s; a time after the impact
    for (int k = 0; k <= 100; ++k) {
      const double time = kTime * k / 100;
      last = find_proximity(shape1, {pose1.position + time * body1.motion.velocity, pose1.rotation}, shape2,
                            {pose2.position + time * body2.motion.velocity, pose2.rotation})
                 .gap;
      least = std::min(least, last);
      if (last < -0.0101 * size) deep = std::min(deep, time);
    }
    if (least < -0.0101 * size) {
      ++impacts;
      REQUIRE(has_contact(manifold));
      // The displacement along the normal is longer than the gap: the contact blocks the motion, no later than the impact.
      const double closing = manifold.deepest.normal.dot(body1.motion.velocity - body2.motion.velocity);
      CHECK(closing * kTime > manifold.deepest.gap);
      CHECK(manifold.deepest.gap <= closing * deep + 1e-9);
    } else if (least > 0) {
      passes += last > 0.01 * size ? 1 : 0;
      if (last > 0.01 * size) CHECK(!has_contact(manifold));
      // A contact with a body that is near at the end does not restrict the free motion.
      const double closing = manifold.deepest.normal.dot(body1.motion.velocity - body2.motion.velocity);
      if (has_contact(manifold)) CHECK(closing * kTime <= manifold.deepest.gap + 1e-12);
    }
  }
  CHECK(impacts > test::draws(300));
  CHECK(passes > test::draws(300));
}

TEST_CASE("a fast impact at one end acts nearer to the centre of mass") {
  const Ellipsoid needle(Vector3(0.01, 0.01, 0.1));
  const Matrix3 slanted = Eigen::AngleAxisd(0.8, Vector3::UnitY()).toRotationMatrix();
  const auto lever_at = [&](double speed) {
    BodyAhead body = moving(needle, {Vector3(0, 0, 0.5), slanted}, Vector3(0, 0, -speed));
    body.motion.turning = Matrix3::Identity() / 2e-3;
    const Proximity now = find_plane_proximity(needle, body.pose, Vector3::UnitZ(), 0);
    body.pose.position.z() -= now.gap;
    body.motion.centre = body.pose.position;
    const Proximity touching = find_plane_proximity(needle, body.pose, Vector3::UnitZ(), 0);
    return std::abs(find_plane_contacts_ahead(body, kTime, touching).deepest.contact.x());
  };
  const double free = lever_at(0.1);
  CHECK(free > 0.06);            // the body's own contact point
  CHECK(lever_at(0.5) == free);  // rotates by less than 0.1 rad
  CHECK(lever_at(100) < 0.001);  // would rotate by 12 rad
  // In between, the lever arm does not jump.
  double before = free;
  for (int k = 0; k <= 300; ++k) {
    const double lever = lever_at(0.5 * std::pow(1.01, k));  // m/s; up to 9.9
    CHECK(lever <= before + 1e-12);
    CHECK(before - lever < 0.1 * free);
    before = lever;
  }
}

TEST_CASE("the end of a needle that swings into a floor within a step comes down on it, and no farther") {
  const Ellipsoid needle(Vector3(0.2, 0.01, 0.01));
  const Box block(Vector3(1, 1, 0.5));
  const BodyAhead floor = standing(block, {Vector3(0, 0, -0.5), Matrix3::Identity()});
  test::Draw random(7);
  int swung = 0;
  for (int draw = 0; draw < 500; ++draw) {
    const double tilt = random.uniform(0, 0.2);
    const Matrix3 rotation = Eigen::AngleAxisd(tilt, Vector3::UnitY()).toRotationMatrix();
    const double turn = -random.uniform(0.05, 0.3);
    BodyAhead body = moving(needle, {Vector3::Zero(), rotation}, Vector3::Zero());
    body.pose.position.z() = needle.support(-rotation.row(2).transpose()) + random.uniform(-1e-3, 1e-3);
    body.motion.centre = body.pose.position;
    body.motion.turning = Vector3(1 / 4e-5, 1 / 8e-3, 1 / 8e-3).asDiagonal();
    body.motion.angular_velocity = Vector3(0, turn / kTime, 0);
    body.motion.arm = needle.bounding_radius();
    const Matrix3 end = Eigen::AngleAxisd(turn, Vector3::UnitY()).toRotationMatrix() * rotation;
    const double overlap = needle.support(-end.row(2).transpose()) - body.pose.position.z();
    const double known = taken_away(body, find_on_plane({needle, body.pose, body.motion}));
    if (overlap < 5e-4) continue;
    CHECK(known > overlap - 1.01e-4);  // a hundredth of the thickness is ignored
    CHECK(known < overlap + 1e-9);
    const ContactManifold found = find(body, floor);
    CHECK(taken_away(body, found) == doctest::Approx(known).epsilon(1e-6));
    // At the start, of the tangent planes at the end, and at the end.
    CHECK(found.deepest.evaluations >= find_proximity(needle, body.pose, block, floor.pose).evaluations + 2);
    // Each place is on the body, as it is now or with its orientation at the end of the step.
    for (int k = 0; k < found.corner_count; ++k) {
      const ManifoldCorner& corner = found.corners[static_cast<std::size_t>(k)];
      const double now = distance_from(body, corner.point);
      const double then = distance_from({needle, {body.pose.position, end}, body.motion}, corner.point);
      CHECK(std::min(std::abs(now), std::abs(then)) < std::max(0.0, corner.depth) + 1e-8);
    }
    ++swung;
  }
  CHECK(swung > 100);
}

TEST_CASE("a flat body in any orientation that falls past the edge of a box is free") {
  test::Draw random(7);
  for (int draw = 0; draw < 3000; ++draw) {
    const double size = std::pow(10, random.uniform(-3, -1));
    const Superellipsoid body_shape(size * Vector3(1, 0.7, 0.5), 20, 20);
    const double half = size * random.uniform(1, 6);
    const Box block(Vector3::Constant(half));
    const Matrix3 on_edge = Eigen::AngleAxisd(std::numbers::pi / 4, Vector3::UnitY()).toRotationMatrix();
    const BodyAhead ledge = standing(block, {Vector3(0, 0, -std::sqrt(2) * half), on_edge});  // its edge is x = z = 0
    const Matrix3 rotation = random.rotation();
    const double low = body_shape.support(rotation.transpose() * -Vector3::UnitZ());
    const Vector3 place(random.uniform(-1, 3) * size, 0, low + 0.01 * size);
    BodyAhead body = moving(body_shape, {place, rotation}, Vector3(-random.uniform(0, 2) * size / kTime, 0, 0));
    body.motion.acceleration = Vector3(-9.81, 0, 0);
    CHECK(taken_away(body, find(body, ledge)) < 1e-9 * size);
  }
}

TEST_CASE("a ball that rolls or spins is borne under its centre") {
  const Ellipsoid ball(Vector3::Constant(0.05));
  const Box block(Vector3(1, 1, 0.5));
  const BodyAhead floor = standing(block, {Vector3(0, 0, -0.5), Matrix3::Identity()});
  for (const double gap : {0.0, 1e-9, 1e-6}) {
    for (const double turn : {0.1, 1.2, 6.0}) {
      BodyAhead body = moving(ball, {Vector3(0, 0, 0.05 + gap), Matrix3::Identity()}, Vector3(0.05 * turn / kTime, 0, 0));
      body.motion.acceleration = Vector3(0, 0, -9.81);
      body.motion.angular_velocity = Vector3(0, turn / kTime, 0);
      body.motion.arm = 0.05;
      for (const ContactManifold& manifold : {find_on_plane(body), find(body, floor)}) {
        REQUIRE(has_contact(manifold));
        CHECK((manifold.deepest.normal + Vector3::UnitZ()).norm() < 1e-6);
        CHECK(manifold.deepest.contact.head<2>().norm() < 1e-7);
        CHECK(manifold.deepest.gap == doctest::Approx(gap).epsilon(1e-6).scale(1e-3));
      }
    }
  }
}

TEST_CASE("the faster a body rotates, the farther apart are its manifold points ahead, on a plane and on a body") {
  const Superellipsoid brick({0.1, 0.07, 0.05}, 8, 8);
  const Box floor(Vector3(1, 1, 0.1));
  const auto half_length_at = [&](double turn, bool on_plane) {
    BodyAhead body = standing(brick, {Vector3(0, 0, 0.0502), Matrix3::Identity()});
    body.motion.mobility = 1;
    body.motion.angular_velocity = Vector3(turn / kTime, 0, 0);
    body.motion.arm = 0.14;
    const BodyAhead below = standing(floor, {Vector3(0, 0, -0.1), Matrix3::Identity()});
    const ContactManifold manifold =
        on_plane ? find_plane_contacts_ahead(body, kTime, find_plane_proximity(brick, body.pose, Vector3::UnitZ(), 0))
                 : find(body, below);
    REQUIRE(manifold.corner_count == 4);
    return std::abs(manifold.corners[0].point.x());
  };
  for (const bool on_plane : {true, false}) {
    const double resting = half_length_at(0, on_plane);
    CHECK(half_length_at(0.003, on_plane) == resting);  // comes no nearer than the gap
    CHECK(half_length_at(0.1, on_plane) > 1.1 * resting);
    CHECK(half_length_at(3, on_plane) == half_length_at(30, on_plane));
    double before = half_length_at(0.008, on_plane);
    for (int k = 0; k <= 1000; ++k) {  // no jump, from where it touches within the step
      const double now = half_length_at(0.008 * std::pow(1.005, k), on_plane);
      CHECK(now >= before);
      CHECK(now - before < 0.02 * resting);
      before = now;
    }
  }
}

TEST_CASE("the deepest contact of a brick that rocks is at its witness points") {
  const Superellipsoid brick({0.1, 0.07, 0.05}, 20, 20);
  const Box block(Vector3(1, 1, 0.1));
  const BodyAhead floor = standing(block, {Vector3(0, 0, -0.1), Matrix3::Identity()});
  test::Draw draw(62);
  int apart = 0;
  for (int i = 0; i < test::draws(300); ++i) {
    CAPTURE(i);
    const Matrix3 rotation = Eigen::AngleAxisd(draw.log_uniform(0.01, 1), draw.direction()).toRotationMatrix();
    const double low = brick.support(rotation.transpose() * -Vector3::UnitZ());
    BodyAhead body = standing(brick, {Vector3(0, 0, low + draw.log_uniform(1e-5, 0.03)), rotation});
    body.motion.mobility = 1;
    body.motion.velocity = Vector3(0, 0, draw.uniform(-2, 2));
    body.motion.angular_velocity = draw.in_box({60, 60, 60});
    body.motion.acceleration = Vector3(0, 0, -9.81);
    body.motion.arm = 0.14;
    for (const auto& [deepest, share] : {std::pair(find_on_plane(body).deepest, 1.0), std::pair(find(body, floor).deepest, 1.0),
                                         std::pair(find(floor, body).deepest, 0.0)}) {
      if (deepest.status == Status::Apart || !(deepest.gap > 0)) continue;  // an overlap of tangent planes is no gap
      ++apart;
      CHECK((deepest.contact - share * deepest.point1 - (1 - share) * deepest.point2).norm() < 1e-9);
      CHECK((deepest.point2 - deepest.point1 - deepest.gap * deepest.normal).norm() < 1e-9);
    }
  }
  CHECK(apart > test::draws(300));
}

TEST_CASE("with a velocity that is not finite a body keeps its present contact") {
  const Ellipsoid ball(Vector3(0.05, 0.05, 0.05));
  const Box wall(Vector3(1, 1, 0.01));
  const Pose touching{Vector3(0, 0, 0.06 - 1e-4), Matrix3::Identity()};
  for (const double odd : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    const ContactManifold manifold = find(moving(ball, touching, Vector3(odd, 0, 0)), standing(wall, {}));
    CHECK(manifold.deepest.gap == doctest::Approx(-1e-4));
    CHECK(has_contact(manifold));
  }
}
