// The 1600 pairs with known answers (tests/data/superellipsoid_pairs.csv; tests/data/README.md describes their origin).
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal::test {

/// Nominal gaps / smallest half-axis of the file's groups of 25. If several translations separate the bodies, the true depth is
/// less.
inline constexpr std::array<double, 8> kNominalGaps = {0.5, 0.1, 1e-3, 0, -1e-3, -0.02, -0.1, -0.3};
inline constexpr std::size_t kGroupSize = 25;

struct ReferencePair {
  std::string name;    // class and line in the file
  std::string kind;    // class
  double nominal = 0;  // one of kNominalGaps
  std::shared_ptr<const Shape> shape1, shape2;
  Superellipsoid surface1{Vector3::Ones(), 2, 2}, surface2{Vector3::Ones(), 2, 2};  // the same bodies, for the implicit equation
  Pose pose1, pose2;
  double unit = 0;  // smallest half-axis, m
  double gap = 0;
  Vector3 normal, point1, point2;
  bool is_unique = false, is_well = false;

  bool is_apart_or_touching() const { return nominal >= -1e-3; }
};

/// An Ellipsoid if both exponents are 2: the shape that a program would choose.
inline std::shared_ptr<const Shape> make_shape(const Superellipsoid& shape) {
  if (shape.delta() == 2 && shape.epsilon() == 2) return std::make_shared<Ellipsoid>(shape.half_axes());
  return std::make_shared<Superellipsoid>(shape);
}

/// The left side of the implicit equation as a norm: 1 on the boundary, and 1 + x at a point 1 + x times as far out.
inline double gauge(const Superellipsoid& shape, const Vector3& point) {
  const Vector3 x = point.cwiseAbs().cwiseQuotient(shape.half_axes());
  const double delta = shape.delta(), epsilon = shape.epsilon();
  const auto norm = [](double a, double b, double exponent) {
    const double large = std::max(a, b), small = std::min(a, b);
    return large == 0 ? 0 : large * std::pow(1 + std::pow(small / large, exponent), 1 / exponent);
  };
  return norm(norm(x.x(), x.y(), delta), x.z(), epsilon);
}

inline ReferencePair parse_reference_pair(const std::string& line, std::size_t index) {
  std::istringstream in(line);
  ReferencePair pair;
  std::getline(in, pair.kind, ',');
  std::vector<double> v;
  for (std::string field; std::getline(in, field, ',');) v.push_back(std::stod(field));
  if (v.size() != 29) throw std::runtime_error("superellipsoid_pairs.csv: 30 columns expected in: " + line);
  const auto vector = [&](std::size_t first) { return Vector3(v[first], v[first + 1], v[first + 2]); };
  pair.name = pair.kind + " pair " + std::to_string(index);
  pair.nominal = kNominalGaps[index / kGroupSize % kNominalGaps.size()];
  pair.surface1 = Superellipsoid(vector(0), v[3], v[4]);
  pair.surface2 = Superellipsoid(vector(5), v[8], v[9]);
  pair.shape1 = make_shape(pair.surface1);
  pair.shape2 = make_shape(pair.surface2);
  pair.pose2.position = vector(10);
  pair.pose2.rotation = Eigen::Quaterniond(v[13], v[14], v[15], v[16]).normalized().toRotationMatrix();
  pair.unit = std::min(vector(0).minCoeff(), vector(5).minCoeff());
  pair.gap = v[17];
  pair.normal = vector(18);
  pair.point1 = vector(21);
  pair.point2 = vector(24);
  pair.is_unique = v[27] == 1;
  pair.is_well = v[28] == 1;
  return pair;
}

inline std::vector<ReferencePair> load_reference_pairs() {
  std::ifstream file(SUPERNORMAL_TEST_DATA "/superellipsoid_pairs.csv");
  if (!file) throw std::runtime_error("cannot read " SUPERNORMAL_TEST_DATA "/superellipsoid_pairs.csv");
  std::vector<ReferencePair> pairs;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line.rfind("class,", 0) == 0) continue;
    pairs.push_back(parse_reference_pair(line, pairs.size()));
  }
  return pairs;
}

/// The pairs, read once.
inline const std::vector<ReferencePair>& reference_pairs() {
  static const std::vector<ReferencePair> pairs = load_reference_pairs();
  return pairs;
}

inline Proximity solve(const ReferencePair& pair, const Settings& settings = {}, const Vector3* first_normal = nullptr) {
  return find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, settings, first_normal);
}

}  // namespace supernormal::test
