// Comparison of numbers by their relative difference.
#pragma once

#include <doctest/doctest.h>

#include <cmath>

namespace supernormal::test {

/// The value that relative() returns.
class Relative {
 public:
  explicit constexpr Relative(double expected, double epsilon = 1e-5) : expected_(expected), epsilon_(epsilon) {}
  constexpr Relative epsilon(double epsilon) const { return Relative(expected_, epsilon); }

  friend bool operator==(double value, const Relative& other) {
    return std::abs(value - other.expected_) < other.epsilon_ * std::abs(other.expected_);
  }
  // NOLINTNEXTLINE(readability-identifier-naming): doctest's name
  friend doctest::String toString(const Relative& relative) {
    return doctest::toString(relative.expected_) + " (1 +- " + doctest::toString(relative.epsilon_) + ")";
  }

 private:
  double expected_;
  double epsilon_;
};

/// Equal to `expected` within less than .epsilon(e) times its size. doctest's own Approx adds 1 to that size, so it would check
/// nothing for a millimetre in metres. No number equals relative(0).
constexpr Relative relative(double expected) { return Relative(expected); }

}  // namespace supernormal::test
