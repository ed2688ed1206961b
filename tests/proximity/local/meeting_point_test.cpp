// Tests of contacts between bodies that both have faces or straight edges.
#include "proximity/local/meeting_point.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "support/draw.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

struct Named {
  std::string name;
  std::shared_ptr<const Shape> shape;
};

std::vector<Named> bodies_with_straight_edges() {
  static const std::vector<Vector3> tetrahedron = {{1, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {-1, 1, -1}};
  static const std::vector<Vector3> many = random_normals(30, 91);
  return {{"box", std::make_shared<Box>(Vector3(1, 0.7, 1.4))},
          {"capsule", std::make_shared<Capsule>(0.5, 1)},
          {"segment", std::make_shared<Capsule>(0, 1)},
          {"tetrahedron", std::make_shared<Polytope>(tetrahedron)},
          {"polytope", std::make_shared<Polytope>(many)}};
}

/// Both bodies in random orientations, `gap` apart; the second pose.
Pose place(const Shape& shape1, const Pose& pose1, const Shape& shape2, double gap, Draw& draw) {
  Pose pose2{4 * draw.direction(), draw.rotation()};
  const Proximity far = find_proximity(shape1, pose1, shape2, pose2);
  pose2.position -= (far.gap - gap) * far.normal;
  return pose2;
}

/// The points of two segments that are nearest to each other, by projecting each point onto the other segment in turn.
struct NearestPoints {
  Vector3 point1, point2;

  NearestPoints(const Pose& pose1, const Pose& pose2, double half_length) {
    const Vector3 u = pose1.rotation.col(2), v = pose2.rotation.col(2), between = pose2.position - pose1.position;
    double x = 0, y = 0;
    for (int step = 0; step < 20000; ++step) {
      const double before = x;
      x = std::clamp(u.dot(between + y * v), -half_length, half_length);
      y = std::clamp(v.dot(x * u - between), -half_length, half_length);
      if (std::abs(x - before) < 1e-15) break;
    }
    point1 = pose1.position + x * u;
    point2 = pose2.position + y * v;
  }
};

}  // namespace

TEST_CASE("two capsules touch where their segments are nearest to one another") {
  Draw draw(92);
  const Capsule capsule1(0.5, 1), capsule2(0.3, 1);
  for (int sample = 0; sample < 3000; ++sample) {
    const Pose pose1{Vector3::Zero(), draw.rotation()};
    const double depth = 0.02 * draw.uniform(0, 1);
    const Pose pose2 = place(capsule1, pose1, capsule2, -depth, draw);
    const Proximity out = find_proximity(capsule1, pose1, capsule2, pose2);
    const NearestPoints nearest(pose1, pose2, 1);
    const Vector3 way = nearest.point2 - nearest.point1;
    const Vector3 contact = nearest.point1 + (0.5 + 0.5 * (way.norm() - 0.8)) * way.normalized();
    if (!((out.contact - contact).norm() <= 1e-4)) FAIL_CHECK("sample ", sample, " off by ", (out.contact - contact).norm());
  }
}

TEST_CASE("bodies with straight edges have their witness points opposite one another, and in both bodies") {
  constexpr double kAcross = 1e-6;
  constexpr double kHeight = 2e-9;
  Draw draw(93);
  const std::vector<Named> bodies = bodies_with_straight_edges();
  for (const Named& one : bodies) {
    for (const Named& other : bodies) {
      for (int sample = 0; sample < 300; ++sample) {
        const Pose pose1{Vector3::Zero(), draw.rotation()};
        const double gap = sample % 3 == 0 ? 0.05 : -0.02 * draw.uniform(0, 1);
        const bool is_thin = one.name == "segment" && other.name == "segment";  // segments do not overlap
        const Pose pose2 = place(*one.shape, pose1, *other.shape, is_thin ? 0.05 : gap, draw);
        const Proximity out = find_proximity(*one.shape, pose1, *other.shape, pose2);
        CAPTURE(one.name);
        CAPTURE(other.name);
        CAPTURE(sample);
        REQUIRE(out.status == Status::Converged);
        const double across = (out.point2 - out.point1 - out.gap * out.normal).norm();
        if (!(across <= kAcross)) FAIL_CHECK("witness points are ", across, " beside one another");
        // A point is in a body if no support plane is below it; those with normals near this one are the ones at risk.
        for (const Vector3& turn : random_normals(10, 94)) {
          const Vector3 n = (out.normal + 0.1 * turn).normalized();
          const Vector3 m1 = pose1.rotation.transpose() * n, m2 = -(pose2.rotation.transpose() * n);
          const double above1 = n.dot(out.point1 - pose1.position) - one.shape->support(m1);
          const double above2 = -n.dot(out.point2 - pose2.position) - other.shape->support(m2);
          if (!(std::max(above1, above2) <= kHeight)) FAIL_CHECK("a witness point is ", std::max(above1, above2), " outside");
        }
      }
    }
  }
}

TEST_CASE("a capsule across a cylinder touches it where it lies on it") {
  // On the cap, with an end beyond the edge, and on the rounded side.
  const Capsule capsule(0.5, 1);
  const Cylinder cylinder(0.8, 0.9);
  const Matrix3 lying = Eigen::AngleAxis<double>(std::acos(0.0), Vector3::UnitY()).toRotationMatrix();
  const Pose on_cap{Vector3(0.9, 0, 0.9 + 0.5 - 0.01), lying};
  const Pose on_side{Vector3(0, 0.8 + 0.5 - 0.01, 0.3), lying};
  for (const bool is_swapped : {false, true}) {
    const auto query = [&](const Pose& pose) {
      return is_swapped ? find_proximity(cylinder, {}, capsule, pose) : find_proximity(capsule, pose, cylinder, {});
    };
    const Vector3 cap = query(on_cap).contact;
    CHECK(std::abs(cap.z() - 0.895) <= 1e-8);
    CHECK(std::abs(cap.y()) <= 0.8);
    CHECK(cap.x() >= -0.1 - 1e-8);
    CHECK(cap.x() <= 0.8 + 1e-8);
    const Vector3 side = query(on_side).contact;
    CHECK((side - Vector3(0, 0.795, 0.3)).norm() <= 1e-4);
  }
}

TEST_CASE("what is far below its tangent plane does not become a witness point") {
  // At this normal, which is none that both have, the boxes' nearest vertices are their only points.
  const Box box(Vector3(1, 1, 1));
  GapFunction gap(box, {}, box, {Vector3(2.5, 0.3, 0.2), Matrix3::Identity()});
  GapJet jet;
  gap.evaluate(Vector3(1, 0.2, 0.1).normalized(), Order::Hessian, jet);
  GapJet moved = jet;
  MeetingPoint(gap).move_witnesses(1e-9, moved);
  CHECK(moved.jet1.r == jet.jet1.r);
  CHECK(moved.d == jet.d);
}

TEST_CASE("an edge across the edge of a cylinder's cap: the contact is on both") {
  Draw draw(95);
  const Box box(Vector3(1, 0.7, 1.4));
  const Cylinder cylinder(0.8, 0.9);
  for (int sample = 0; sample < 1000; ++sample) {
    const Pose pose1{Vector3::Zero(), draw.rotation()};
    const Pose pose2 = place(box, pose1, cylinder, -0.01 * draw.uniform(0, 1), draw);
    const Proximity out = find_proximity(box, pose1, cylinder, pose2);
    if (out.status != Status::Converged) continue;
    const Vector3 in_box = pose1.rotation.transpose() * (out.contact - pose1.position);
    const Vector3 in_cylinder = pose2.rotation.transpose() * (out.contact - pose2.position);
    const double beside = (in_box.cwiseAbs() - Vector3(1, 0.7, 1.4)).maxCoeff();
    const double beside_cylinder = std::max(std::hypot(in_cylinder.x(), in_cylinder.y()) - 0.8, std::abs(in_cylinder.z()) - 0.9);
    if (!(std::max(beside, beside_cylinder) <= 1e-3)) FAIL_CHECK("sample ", sample, " off by ", beside, " and ", beside_cylinder);
  }
}

// Cuts at points of a cap's edge that coincide but for rounding do not show where the edge continues.
TEST_CASE("a cylinder that overlaps a box or another cylinder converges") {
  Draw draw(61);
  const auto direction = [&] { return draw.within(-1, 1).normalized(); };
  for (int k = 0; k < 4000; ++k) {
    CAPTURE(k);
    const Cylinder cylinder(draw.uniform(0.3, 1), draw.uniform(0.3, 1));
    const Box box(draw.within(0.3, 1));
    const Cylinder other(draw.uniform(0.3, 1), draw.uniform(0.3, 1));
    const Shape& partner = k % 2 == 0 ? static_cast<const Shape&>(box) : other;
    Pose pose2;
    pose2.rotation = Eigen::AngleAxisd(draw.uniform(0, 3), direction()).toRotationMatrix();
    const Vector3 n = direction();
    const double depth = k % 4 < 2 ? std::pow(10, draw.uniform(-6, -2)) : draw.uniform(0.01, 0.3);
    pose2.position = cylinder.point(n) - depth * n - pose2.rotation * partner.point(-(pose2.rotation.transpose() * n));
    CHECK(find_proximity(cylinder, {}, partner, pose2).status == Status::Converged);
  }
}
