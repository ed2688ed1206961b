#include "random_geometry.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace accuracy_cost {

using common::Random;
using supernormal::Matrix3;
using supernormal::Vector3;

double uniform(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

Vector3 random_normal(Random& random) {
  const double z = uniform(random, -1, 1);
  const double angle = 2 * std::numbers::pi * random.uniform();
  const double across = std::sqrt(1 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

Matrix3 random_orientation(Random& random) {
  const auto [w, x, y, z] = random.rotation();
  return Eigen::Quaterniond(w, x, y, z).toRotationMatrix();
}

}  // namespace accuracy_cost
