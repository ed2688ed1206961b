// Tests of what shapes say of the points inside them, against their boundary points.
#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <vector>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/callback_shape.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/linear_image.hpp"
#include "supernormal/shapes/minkowski_sum.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/rounded.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superovoid.hpp"
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
