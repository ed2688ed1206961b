// Random numbers and rotations, and how many cases a test takes.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <vector>

namespace supernormal::test {

/// Whether tests run at length (supernormal_add_doctest).
inline bool at_length() { return std::getenv("SUPERNORMAL_AT_LENGTH") != nullptr; }

/// Of `count` random cases a quarter, and all of them at length.
inline int draws(int count) { return at_length() ? count : (count + 3) / 4; }

/// Of these cases every third, and all of them at length.
template <typename Case>
std::vector<Case> some_of(const std::vector<Case>& cases) {
  std::vector<Case> some;
  for (std::size_t k = 0; k < cases.size(); k += at_length() ? 1 : 3) some.push_back(cases[k]);
  return some;
}

inline double uniform(std::mt19937_64& engine, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(engine);
}

inline Eigen::Matrix3d random_rotation(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(engine), normal(engine), normal(engine), normal(engine)).normalized().toRotationMatrix();
}

}  // namespace supernormal::test
