// Tests of the points of a superellipsoid with four normals at once.
#include "shapes/lanes/four_normals.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "shapes/lanes/lane_body_of.hpp"
#include "support/shape_samples.hpp"

using namespace supernormal;
using namespace supernormal::test;

namespace {

using FourVectors = Eigen::Array<double, 4, 3>;

struct Evaluated {
  Eigen::Array4d h;
  FourVectors points;
  Evaluated(EvaluateFour* evaluate, const Superellipsoid& shape, const FourVectors& normals) {
    evaluate(*LaneBodies::of(shape), normals.data(), h.data(), points.data());
  }
};

}  // namespace

TEST_CASE("four normals at once have the points of each alone to rounding, at any length, and the same digits in every width") {
  std::vector<Vector3> normals = all_normals(300, 1);
  // A subnormal component loses digits with the length.
  std::erase_if(normals, [](const Vector3& n) { return (n.array().abs() > 0 && n.array().abs() < 1e-300).any(); });
  for (const Superellipsoid& shape : superellipsoids(1.02, 200)) {
    const double size = shape.half_axes().norm();
    for (std::size_t first = 0; first + 4 <= normals.size(); first += 4) {
      FourVectors four;
      for (int k = 0; k < 4; ++k) four.row(k) = (k + 0.5) * normals[first + static_cast<std::size_t>(k)].transpose().array();
      const Evaluated together(four_at_once(), shape, four), narrow(evaluate_in_two_lanes, shape, four);
      CHECK((together.h == narrow.h).all());
      CHECK((together.points == narrow.points).all());
      for (int k = 0; k < 4; ++k) {
        const Jet alone = shape.jet(normals[first + static_cast<std::size_t>(k)]);
        CHECK(std::abs(together.h[k] / (k + 0.5) - alone.h) <= 1e-14 * size);
        CHECK((together.points.row(k).transpose().matrix() - alone.r).norm() <= 1e-11 * size);
      }
    }
  }
}
