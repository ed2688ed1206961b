// Superellipsoid: from octahedron (exponents near 1) through ellipsoid (2) to box (large exponents).
#pragma once

#include <memory>

#include "supernormal/shapes/lane_body.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

struct NestedNorms;

/// (|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon = 1 in the body's frame.
///
/// With the dual exponents p = delta/(delta-1) and q = epsilon/(epsilon-1) the support function is two nested norms:
///     t = (|a nx|^p + |b ny|^p)^(1/p),   h = (t^q + |c nz|^q)^(1/q).
/// The larger term is factored out, so nothing over- or underflows (lib/shapes/README.md). The function printed in Roemer's paper
/// has a misprinted exponent. This one satisfies the implicit equation.
class SUPERNORMAL_API Superellipsoid final : public Shape {
 public:
  static constexpr double kMinExponent = 1.01;  ///< the smallest exponent
  static constexpr double kMaxExponent = 1000;  ///< the largest exponent

  /// Half-axes in m, finite and in [1e-30, 1e30]; exponents in [kMinExponent, kMaxExponent]; std::invalid_argument otherwise.
  Superellipsoid(const Vector3& half_axes, double delta, double epsilon);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override { return traits_; }

  /// Moves the boundary point and takes the normal there, the gradient of the implicit function. On a flat face r is a high power
  /// of n, so r changes steeply with n; n changes slowly with r.
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override;

  bool surely_contains(const Vector3& point) const override;
  /// The half-axes "a", "b" and "c", and the exponents "delta" and "epsilon".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  Vector3 half_extents() const override { return half_axes_; }
  double bounding_radius() const override { return bounding_radius_; }
  double min_curvature_radius_estimate() const override;
  double rolling_radius() const override { return rolling_radius_; }
  MassProperties mass_properties() const override;

  const Vector3& half_axes() const { return half_axes_; }  ///< m; a, b and c
  double delta() const { return delta_; }                  ///< exponent of the section
  double epsilon() const { return epsilon_; }              ///< exponent of the meridian

 private:
  friend class SuperellipsoidBatch;
  friend class LaneBodies;

  Vector3 half_axes_;
  double delta_, epsilon_;
  std::shared_ptr<const NestedNorms> norms_;
  ShapeTraits traits_;
  double rolling_radius_, bounding_radius_;  // m
  LaneBody numbers_;
};

}  // namespace supernormal
