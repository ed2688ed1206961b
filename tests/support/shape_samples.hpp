// Normals and shapes for the tests of the shapes, and a numerical derivative with an error estimate.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "supernormal/shapes/superellipsoid.hpp"
#include "support/draw.hpp"

namespace supernormal::test {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline std::string text(const Vector3& v) {
  std::ostringstream out;
  out.precision(17);
  out << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return out.str();
}

inline std::string text(const Superellipsoid& shape) {
  std::ostringstream out;
  out << "half-axes " << text(shape.half_axes()) << " delta " << shape.delta() << " epsilon " << shape.epsilon();
  return out.str();
}

/// `count` directions, evenly distributed, the same in every run.
inline std::vector<Vector3> random_normals(int count, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> gauss;
  std::vector<Vector3> normals;
  while (static_cast<int>(normals.size()) < count) {
    const Vector3 v{gauss(engine), gauss(engine), gauss(engine)};  // braces fix the order of evaluation
    if (v.norm() > 1e-3) normals.push_back(v.normalized());
  }
  return normals;
}

/// Normals on the axes and coordinate planes, and beside them at distances down to denormal numbers, with every sign; -0 too.
inline std::vector<Vector3> singular_normals() {
  std::vector<Vector3> normals;
  const double beside[] = {0.0, -0.0, 5e-324, 1e-310, -1e-300, 1e-160, -1e-60, 1e-30, 1e-16, -1e-8, 1e-3};
  for (int axis = 0; axis < 3; ++axis) {
    const int second = (axis + 1) % 3, third = (axis + 2) % 3;
    for (const double sign : {1.0, -1.0}) {
      for (const double one : beside) {
        for (const double other : beside) {  // beside the axis
          Vector3 n;
          n[axis] = sign;
          n[second] = one;
          n[third] = other;
          normals.push_back(n.normalized());
        }
        for (const double angle : {0.1, 0.7853981633974483, 1.2}) {  // beside the plane
          Vector3 n;
          n[axis] = sign * std::cos(angle);
          n[second] = std::sin(angle);
          n[third] = one;
          normals.push_back(n.normalized());
        }
      }
    }
  }
  return normals;
}

/// The singular normals and `count` random ones.
inline std::vector<Vector3> all_normals(int count, unsigned seed) {
  std::vector<Vector3> normals = singular_normals();
  const std::vector<Vector3> random = random_normals(count, seed);
  normals.insert(normals.end(), random.begin(), random.end());
  return normals;
}

/// Superellipsoids of all exponents from `min_exponent` up to `max_exponent`, in four proportions (aspect ratios up to 100).
inline std::vector<Superellipsoid> superellipsoids(double min_exponent, double max_exponent) {
  const Vector3 proportions[] = {{1, 1, 1}, {3, 2, 1}, {0.01, 1, 0.3}, {0.5, 0.02, 2}};
  std::vector<Superellipsoid> shapes;
  for (const double delta : {1.01, 1.02, 1.3, 1.8, 2.0, 2.4, 4.0, 7.5, 20.0, 50.0, 200.0, 1000.0}) {
    for (const double epsilon : {1.01, 1.02, 1.3, 1.8, 2.0, 2.4, 4.0, 7.5, 20.0, 50.0, 200.0, 1000.0}) {
      if (std::min(delta, epsilon) < min_exponent || std::max(delta, epsilon) > max_exponent) continue;
      for (const Vector3& half_axes : proportions) shapes.emplace_back(half_axes, delta, epsilon);
    }
  }
  return some_of(shapes);
}

/// Two unit vectors orthogonal to n and to one another.
inline std::array<Vector3, 2> tangents(const Vector3& n) {
  const Vector3 t = n.unitOrthogonal();
  return {t, n.cross(t)};
}

struct Derivative {
  Vector3 value;
  double error;  // estimated
};

/// f'(0) by Ridders' method: central differences with ever smaller steps, extrapolated to step 0, until rounding takes over.
Derivative derivative(const auto& f, double first_step) {
  constexpr int kLevels = 12;
  constexpr double kShrink = 1.6;
  Vector3 table[kLevels][kLevels];
  Derivative best{Vector3::Zero(), std::numeric_limits<double>::infinity()};
  double step = first_step;
  for (int level = 0; level < kLevels; ++level, step /= kShrink) {
    table[level][0] = (f(step) - f(-step)) / (2 * step);
    double factor = kShrink * kShrink;
    for (int order = 1; order <= level; ++order, factor *= kShrink * kShrink) {
      table[level][order] = (factor * table[level][order - 1] - table[level - 1][order - 1]) / (factor - 1);
      const double error = std::max((table[level][order] - table[level][order - 1]).norm(),
                                    (table[level][order] - table[level - 1][order - 1]).norm());
      if (error < best.error) best = {table[level][order], error};
    }
  }
  return best;
}

}  // namespace supernormal::test
