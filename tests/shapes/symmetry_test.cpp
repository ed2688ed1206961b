// Tests of the shapes' claims of symmetry against their support functions.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <memory>

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

/// Compares both sides digit by digit.
bool has_equal_sides(const Shape& shape, const std::vector<Vector3>& normals) {
  return std::ranges::all_of(normals, [&](const Vector3& n) { return shape.support(n) == shape.support(-n); });
}

}  // namespace

TEST_CASE("superellipsoids are symmetric about the origin") {
  const std::vector<Vector3> normals = all_normals(300, 1);
  for (const Superellipsoid& shape : superellipsoids(1.01, 1000)) {
    CHECK(shape.traits().is_symmetric);
    if (!has_equal_sides(shape, normals)) FAIL_CHECK(text(shape));
  }
}

TEST_CASE("a shape is symmetric about the origin if it says so; others are not") {
  const std::array<Vector3, 4> vertices = {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1), Vector3(-1, -1, -1)};
  const auto grain = std::make_shared<Superellipsoid>(Vector3(3, 2, 1), 3.5, 1.7);
  const auto box = std::make_shared<Box>(Vector3(0.3, 0.2, 0.7));
  const auto egg = std::make_shared<Superovoid>(Vector3(1, 2, 3), 2.5, 2.5, 0.2, 0.2);
  Matrix3 shear;
  shear << 2, 0.5, 0, -0.3, 1, 0.1, 0.7, 0, 0.4;
  const std::vector<std::shared_ptr<const Shape>> symmetric = {
      box,
      std::make_shared<Sphere>(0.3),
      std::make_shared<Ellipsoid>(Vector3(3, 2, 1)),
      std::make_shared<Capsule>(0.3, 2),
      std::make_shared<Cylinder>(0.3, 2),
      std::make_shared<Rounded>(grain, 0.1),
      std::make_shared<LinearImage>(grain, shear),
      std::make_shared<MinkowskiSum>(grain, box),
  };
  const std::vector<std::shared_ptr<const Shape>> others = {
      egg,
      std::make_shared<Polytope>(vertices),
      std::make_shared<CallbackShape>([](const Vector3& n) { return 1 + 0.1 * n.x(); },
                                      [](const Vector3& n) { return Vector3(n + 0.1 * Vector3::UnitX()); }),
      std::make_shared<Rounded>(egg, 0.1),
      std::make_shared<LinearImage>(egg, shear),
      std::make_shared<MinkowskiSum>(grain, egg),
      std::make_shared<MinkowskiSum>(egg, box),
  };
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
