// Tests of what shapes say of their extent, of the points inside them, and of their symmetry, against their boundary points.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "supernormal/shapes/bounding_box.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/silhouette.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/submerged_volume.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "support/relative.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

using Shapes = std::vector<std::shared_ptr<const Shape>>;

Shapes with_equation() {
  Shapes shapes = {
      std::make_shared<Sphere>(0.3),
      std::make_shared<Ellipsoid>(Vector3(3, 2, 1e-3)),
      std::make_shared<Box>(Vector3(0.3, 0.2, 0.7)),
      std::make_shared<Capsule>(0.3, 2),
      std::make_shared<Cylinder>(0.3, 2),
      std::make_shared<Superovoid>(Vector3(1, 2, 3), 2.5, 2, 0.3, -0.2),
      std::make_shared<Superovoid>(Vector3(1, 2, 3), 60, 1.1, 0.01, 0.02),
  };
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) shapes.push_back(std::make_shared<Superellipsoid>(shape));
  return shapes;
}

/// Shapes of which the point that is asked for may be inside or not.
Shapes without_equation() {
  static const std::array<Vector3, 4> vertices = {Vector3(1, 0, 9), Vector3(0, 1, 9), Vector3(0, 0, 10), Vector3(-1, -1, 8)};
  const auto grain = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 3.5, 1.7);
  const auto ball_aside = [](const Vector3& n) { return Vector3(n + 3 * Vector3::UnitX()); };
  Matrix3 shear;
  shear << 2, 0.5, 0, -0.3, 1, 0.1, 0.7, 0, 0.4;
  const auto hull = std::make_shared<Polytope>(vertices);
  return {
      hull,
      std::make_shared<CallbackShape>([=](const Vector3& n) { return n.dot(ball_aside(n)); }, ball_aside),
      std::make_shared<Rounded>(grain, 0.1),
      std::make_shared<Rounded>(hull, 0.1),
      std::make_shared<LinearImage>(hull, shear),
      std::make_shared<MinkowskiSum>(grain, hull),
  };
}

constexpr double kRounding = 1e-15;

Pose somewhere() { return {{0.3, -2, 5}, Eigen::AngleAxisd(0.7, Vector3(1, 2, -2).normalized()).toRotationMatrix()}; }

void check_box(const BoundingBox& box, const Vector3& centre, const Vector3& half_lengths) {
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::abs(box.low[axis] - (centre[axis] - half_lengths[axis])) <= kRounding * 8);
    CHECK(std::abs(box.high[axis] - (centre[axis] + half_lengths[axis])) <= kRounding * 8);
  }
}

/// Compares both sides digit by digit.
bool has_equal_sides(const Shape& shape, const std::vector<Vector3>& normals) {
  return std::ranges::all_of(normals, [&](const Vector3& n) { return shape.support(n) == shape.support(-n); });
}

}  // namespace

TEST_CASE("a body surely contains what is inside its boundary, where there is an equation, and nothing outside") {
  const std::vector<Vector3> normals = all_normals(300, 1);
  for (const auto& shape : with_equation()) {
    CHECK(shape->surely_contains(Vector3::Zero()));
    for (const Vector3& n : normals) {
      CHECK(shape->surely_contains((1 - 1e-12) * shape->point(n)));
      CHECK(!shape->surely_contains((1 + 1e-12) * shape->point(n)));
    }
  }
  for (const auto& shape : without_equation()) {
    for (const Vector3& n : normals) CHECK(!shape->surely_contains(shape->point(n) + 1e-9 * n));
  }
  const Rounded rounded(std::make_shared<Box>(Vector3(1, 2, 3)), 0.1);
  CHECK(rounded.surely_contains(Vector3(0.9, -1.9, 2.9)));
}

TEST_CASE("no point of a body is beyond its bounding radius, which is at most the distance of the bounding box's vertex") {
  const std::vector<Vector3> normals = all_normals(300, 1);
  Shapes shapes = with_equation();
  for (const auto& shape : without_equation()) shapes.push_back(shape);
  for (const auto& shape : shapes) {
    const double radius = shape->bounding_radius();
    double farthest = 0;
    for (const Vector3& n : normals) farthest = std::max(farthest, shape->point(n).norm());
    CHECK(farthest <= radius * (1 + 1e-15));
    CHECK(radius <= 2 * farthest);
  }
}

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

TEST_CASE("a shape is symmetric about the origin if it says so; others are not") {
  const std::array<Vector3, 4> vertices = {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(-1, -1, -1)};
  const auto grain = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 3.5, 1.7);
  const auto box = std::make_shared<Box>(Vector3(0.3, 0.2, 0.7));
  const auto egg = std::make_shared<Superovoid>(Vector3(1, 2, 3), 2.5, 2.5, 0.2, 0.2);
  Matrix3 shear;
  shear << 2, 0.5, 0, -0.3, 1, 0.1, 0.7, 0, 0.4;
  Shapes symmetric = {
      box,
      std::make_shared<Sphere>(0.3),
      std::make_shared<Ellipsoid>(Vector3(3, 2, 1)),
      std::make_shared<Capsule>(0.3, 2),
      std::make_shared<Cylinder>(0.3, 2),
      std::make_shared<Rounded>(grain, 0.1),
      std::make_shared<LinearImage>(grain, shear),
      std::make_shared<MinkowskiSum>(grain, box),
  };
  const Shapes others = {
      egg,
      std::make_shared<Polytope>(vertices),
      std::make_shared<CallbackShape>([](const Vector3& n) { return 1 + 0.1 * n.x(); },
                                      [](const Vector3& n) { return Vector3(n + 0.1 * Vector3::UnitX()); }),
      std::make_shared<Rounded>(egg, 0.1),
      std::make_shared<LinearImage>(egg, shear),
      std::make_shared<MinkowskiSum>(grain, egg),
      std::make_shared<MinkowskiSum>(egg, box),
  };
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) symmetric.push_back(std::make_shared<Superellipsoid>(shape));
  const std::vector<Vector3> normals = all_normals(300, 1);
  for (const auto& shape : symmetric) {
    CHECK(shape->traits().is_symmetric);
    CHECK(has_equal_sides(*shape, normals));
  }
  for (const auto& shape : others) {
    CHECK(!shape->traits().is_symmetric);
    CHECK(!has_equal_sides(*shape, normals));
  }
}

TEST_CASE("an ellipsoid's silhouette equals its closed form") {
  const Vector3 a(3, 0.2, 1);
  const Ellipsoid body(a);
  for (const Vector3& u : {Vector3(1, 0, 0), Vector3(0, 0, 5), Vector3(1, 2, 3), Vector3(-0.3, 0.9, 0.01)}) {
    const Vector3 n = u.normalized();
    const double area = std::numbers::pi * std::hypot(a.y() * a.z() * n.x(), a.z() * a.x() * n.y(), a.x() * a.y() * n.z());
    CHECK(std::abs(projected_area(body, u) / area - 1) < 1e-12);
  }
}

TEST_CASE("the silhouette of a box-like body equals the silhouette of the box to half a per cent") {
  const Vector3 a(0.3, 0.5, 0.2);
  const Superellipsoid body(a, 800, 800);
  for (const Vector3& u : {Vector3(0, 0, 1), Vector3(1, 1, 1), Vector3(3, 1, -2)}) {
    const Vector3 n = u.normalized().cwiseAbs();
    const double area = 4 * (a.y() * a.z() * n.x() + a.z() * a.x() * n.y() + a.x() * a.y() * n.z());
    CHECK(std::abs(projected_area(body, u) / area - 1) < 0.005);
  }
}

TEST_CASE("the surface of spheroids") {
  const auto oblate = [](double a, double c) {
    const double e = std::sqrt(1 - c * c / (a * a));
    return 2 * std::numbers::pi * a * a * (1 + (1 - e * e) / e * std::atanh(e));
  };
  CHECK(std::abs(surface_area(Ellipsoid(Vector3(2, 2, 2))) / (16 * std::numbers::pi) - 1) < 1e-12);
  CHECK(std::abs(surface_area(Ellipsoid(Vector3(1, 1, 0.4))) / oblate(1, 0.4) - 1) < 1e-3);
}

TEST_CASE("the submerged part of an ellipsoid is the image of a sphere's cap") {
  const Vector3 a(0.3, 0.2, 0.1);
  const SubmergedVolume submerged_volume{Ellipsoid(a)};
  const double whole = 4 * std::numbers::pi / 3 * a.prod();
  CHECK(std::abs(submerged_volume.volume() / whole - 1) < 1e-12);
  const Vector3 up = Vector3(1, -2, 2) / 3;
  const Vector3 scaled = a.cwiseProduct(up);
  for (const double t : {-0.6, 0.0, 0.3, 0.8}) {
    const Submerged part = submerged_volume.below(up, t * scaled.norm());
    const double share = (2 + 3 * t - t * t * t) / 4;
    CHECK(std::abs(part.volume / whole - share) < 0.005);
    const double depth = -3 * (1 - t * t) * (1 - t * t) / (16 * share);  // depth of the cap's centroid, in radii
    CHECK((part.centre - depth * a.cwiseProduct(scaled.normalized())).norm() < 1e-3);
  }
}

TEST_CASE("a body that is wholly in or out of the water is exact") {
  const Superovoid egg(Vector3(0.02, 0.02, 0.03), 2, 2, 0.3, 0.3);
  const SubmergedVolume submerged_volume(egg);
  const MassProperties exact = egg.mass_properties();
  const Submerged all = submerged_volume.below(Vector3::UnitZ(), 1);
  CHECK(all.volume == exact.volume);
  CHECK(all.centre == exact.centroid);
  CHECK(submerged_volume.below(Vector3::UnitZ(), -1).volume == 0);
}
