// Pairs for the tests of samples/explain_pair.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <supernormal/shapes/ellipsoid.hpp>
#include <supernormal/shapes/rounded.hpp>
#include <supernormal/shapes/superellipsoid.hpp>
#include <supernormal/shapes/superovoid.hpp>
#include <vector>

#include "pair/pair.hpp"

namespace explain_pair {

/// Apart, touching and overlapping pairs of round, boxy, sharp and tapered bodies, far from the world's axes.
inline std::vector<Pair> sample_pairs() {
  using namespace supernormal;
  const Matrix3 R1 = Eigen::Quaterniond(0.8, 0.1, -0.3, 0.5).normalized().toRotationMatrix();
  const Matrix3 R2 = Eigen::Quaterniond(0.2, 0.7, 0.4, -0.3).normalized().toRotationMatrix();
  const std::vector<std::shared_ptr<const Shape>> shapes = {
      std::make_shared<Ellipsoid>(Vector3(0.5, 0.4, 0.3)), std::make_shared<Superellipsoid>(Vector3(0.5, 0.4, 0.3), 8, 8),
      std::make_shared<Superellipsoid>(Vector3(0.5, 0.5, 0.3), 1.3, 3),
      std::make_shared<Superovoid>(Vector3(0.3, 0.3, 0.4), 2.5, 2, 0.3, 0.3),
      std::make_shared<Rounded>(std::make_shared<Superellipsoid>(Vector3(0.4, 0.3, 0.3), 20, 20), 0.05)};
  std::vector<Pair> pairs;
  for (const auto& shape1 : shapes) {
    for (const auto& shape2 : shapes) {
      for (const double distance : {1.3, 0.65, 0.4}) {
        const Vector3 place(10, -20, 30), way = Vector3(0.6, -0.5, 0.62).normalized();
        pairs.push_back({"a pair", {"one", shape1, {place, R1}}, {"two", shape2, {place + distance * way, R2}}});
      }
    }
  }
  return pairs;
}

}  // namespace explain_pair
