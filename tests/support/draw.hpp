// Random numbers and rotations.
#pragma once

#include <Eigen/Geometry>
#include <random>

namespace supernormal::test {

inline double uniform(std::mt19937_64& engine, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine);
}

inline Eigen::Matrix3d random_rotation(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine)).normalized().toRotationMatrix();
}

}  // namespace supernormal::test
