// The signed distance of data from a body, and its derivatives.
#pragma once

#include <optional>
#include <span>

#include "body.hpp"

namespace fit {

/// The nearest boundary point of a data point.
struct Witness {
  double distance = 0;                ///< positive outside, negative inside
  Vector3 normal = Vector3::UnitX();  ///< unit, outward, in the frame of the data
  Vector3 foot = Vector3::Zero();     ///< the nearest boundary point, in the frame of the data
};

constexpr double kFineTolerance = 1e-12;
constexpr double kRoughTolerance = 1e-6;  ///< for points at least a hundredth of the size from the body

/// Distances from one body in its pose. Creates the shape once.
class DistanceFunction {
 public:
  /// Distances are accurate to `tolerance` times the smallest half-axis. Normals and derivatives are accurate to its square root.
  explicit DistanceFunction(const Body& body, double tolerance = kFineTolerance);

  /// The distance is the maximum over the unit normals n of n.(x - position) - h(n), inside and outside. Empty when the point is
  /// not finite.
  std::optional<Witness> find(const Vector3& x) const;

  /// Whether the body contains a point. Uses the implicit function, which is much faster than a distance.
  bool contains(const Vector3& x) const;

  /// The derivative of the distance by the body's parameters. The distance is a maximum over n, so this is the derivative at fixed
  /// n.
  Gradient gradient(const Witness& witness) const;

  /// Transforms a direction from the frame of the data to the body's frame.
  Vector3 to_body(const Vector3& direction) const { return rotation_.transpose() * direction; }
  const supernormal::Shape& shape() const { return *shape_; }
  const Body& body() const { return body_; }

 private:
  Vector3 gauge_normal(const Vector3& x) const;

  Body body_;
  double tolerance_;
  Matrix3 rotation_;
  std::unique_ptr<supernormal::Shape> shape_;
};

/// The smallest signed distance of a point from several bodies. Outside it is the distance from their union.
double least_distance(std::span<const DistanceFunction> functions, const Vector3& x);

/// The mean distance of points from a surface about which they scatter isotropically with the standard deviation sigma. It is
/// sigma^2 K / 2 for each principal curvature K = 1/rho, the second-order term of the distance (Kanatani, Statistical Optimization
/// for Geometric Computation, section 14). A fit that ignores it gives too large a body. At an edge, rho < sigma, the series fails.
/// Therefore 1/rho is replaced by 1/sqrt(rho^2 + (0.4 sigma)^2). For rho = 0 this gives the mean distance sqrt(pi/2) sigma from a
/// line.
double noise_offset(const DistanceFunction& function, const Witness& witness, double sigma);

}  // namespace fit
