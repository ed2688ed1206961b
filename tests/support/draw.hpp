// Random numbers and rotations, and how many cases a test takes.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

/// The random numbers of the tests, the same in every run.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}

  double uniform(double low, double high) { return low + (high - low) * (static_cast<double>(engine_() >> 11U) * 0x1p-53); }
  /// A number in [low, high] with an evenly distributed logarithm.
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  /// A whole number from `least` to `most`.
  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(engine_); }
  double gauss() { return gauss_(engine_); }
  std::mt19937_64& engine() { return engine_; }

  // Braces fix the order of evaluation.
  Eigen::Vector3d within(double low, double high) {
    return Eigen::Vector3d{uniform(low, high), uniform(low, high), uniform(low, high)};
  }
  Eigen::Vector3d in_box(const Eigen::Vector3d& half_lengths) { return within(-1, 1).cwiseProduct(half_lengths); }
  Eigen::Vector3d log_within(double low, double high) {
    return Eigen::Vector3d{log_uniform(low, high), log_uniform(low, high), log_uniform(low, high)};
  }
  Eigen::Vector3d direction() { return Eigen::Vector3d{gauss(), gauss(), gauss()}.normalized(); }
  Eigen::Matrix3d rotation() {
    return Eigen::Quaterniond(Eigen::Vector4d{gauss(), gauss(), gauss(), gauss()}).normalized().toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> gauss_;
};

}  // namespace supernormal::test
