// The signed distance of data from a body, and how it depends on the body.
#pragma once

#include <optional>
#include <span>

#include "body.hpp"

namespace fit {

/// The nearest boundary point, seen from a point of the data.
struct Witness {
  double distance = 0;                ///< positive outside, negative inside
  Vector3 normal = Vector3::UnitX();  ///< unit, outward, in the frame of the data
  Vector3 foot = Vector3::Zero();     ///< the nearest boundary point, in the frame of the data
};

constexpr double kFineTolerance = 1e-12;
constexpr double kRoughTolerance = 1e-6;  ///< for points that are a hundredth of the size or more from the body

/// Answers for one body in its place. The shape is made once.
class DistanceFunction {
 public:
  /// Distances are exact to `tolerance` times the smallest half-axis, and normals, and with them derivatives, to its root.
  explicit DistanceFunction(const Body& body, double tolerance = kFineTolerance);

  /// The distance is the maximum over the unit normals n of n.(x - position) - h(n), inside and outside. Nothing when the point is
  /// not finite.
  std::optional<Witness> find(const Vector3& x) const;

  /// Whether the body contains a point: by the implicit function, much faster than a distance.
  bool contains(const Vector3& x) const;

  /// The derivative of the distance with respect to the body's parameters: as it is a maximum over n, that of the function at the
  /// fixed n.
  Gradient gradient(const Witness& witness) const;

  /// A direction of the data's frame in the body's.
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

/// The least of the distances of a point from several bodies: outside, that from their union.
double least_distance(std::span<const DistanceFunction> functions, const Vector3& x);

}  // namespace fit
