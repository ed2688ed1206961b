// The box along the axes of the world, against closed forms and boundary points.
#include "supernormal/shapes/bounding_box.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/relative.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

constexpr double kRounding = 1e-15;

Pose somewhere() {
  Pose pose;
  pose.position = {0.3, -2, 5};
  pose.rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, -2).normalized()).toRotationMatrix();
  return pose;
}

void check_box(const BoundingBox& box, const Vector3& centre, const Vector3& half_lengths) {
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::abs(box.low[axis] - (centre[axis] - half_lengths[axis])) <= kRounding * 8);
    CHECK(std::abs(box.high[axis] - (centre[axis] + half_lengths[axis])) <= kRounding * 8);
  }
}

}  // namespace

TEST_CASE("bounding box: closed forms of a rotated ellipsoid and a rotated box") {
  const Pose pose = somewhere();
  const Vector3 half_axes(1, 0.5, 0.2);
  const Matrix3 scaled = pose.rotation * half_axes.asDiagonal();
  check_box(find_bounding_box(Ellipsoid(half_axes), pose), pose.position, scaled.rowwise().norm());
  check_box(find_bounding_box(Box(half_axes), pose), pose.position, scaled.cwiseAbs().rowwise().sum());
}

TEST_CASE("bounding box: of points it is the range of their coordinates, wherever the origin of the body is") {
  const std::array<Vector3, 3> points{Vector3(1, 2, 3), Vector3(2, 2, 5), Vector3(1.5, 4, 4)};
  const BoundingBox box = find_bounding_box(Polytope(points), {});
  CHECK(box.low == Vector3(1, 2, 3));
  CHECK(box.high == Vector3(2, 4, 5));
}

TEST_CASE("bounding box: a body that is not symmetric fills it, and no boundary point is outside") {
  const Superovoid egg({1, 0.8, 1.2}, 2.4, 2, 0.3, 0.3);
  const Pose pose = somewhere();
  const BoundingBox box = find_bounding_box(egg, pose);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const Vector3 point = pose.position + pose.rotation * egg.point(pose.rotation.transpose() * (side * Vector3::Unit(axis)));
      CHECK(point[axis] == relative(side < 0 ? box.low[axis] : box.high[axis]).epsilon(1e-14));
    }
  }
  for (const Vector3& direction : {Vector3(1, 2, 3), Vector3(-3, 1, 1), Vector3(0.1, -0.4, -2)}) {
    const Vector3 point = pose.position + pose.rotation * egg.point(direction.normalized());
    CHECK((point.array() >= box.low.array()).all());
    CHECK((point.array() <= box.high.array()).all());
  }
}
