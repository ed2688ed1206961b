// Superovoid: a superellipsoid whose section grows or shrinks linearly along z (eggs, teeth, truncated pyramids).
#pragma once

#include <memory>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

struct NestedNorms;

/// With X = 1 + taper_x z/c and Y = 1 + taper_y z/c, in the body's frame:
///     (|x/(a X)|^delta + |y/(b Y)|^delta)^(epsilon/delta) + |z/c|^epsilon = 1.
/// This is a superellipsoid with linear tapering (Barr 1984; as contact geometry: Lopes et al. 2010). With both tapers 0 it is the
/// Superellipsoid.
///
/// It is convex if and only if, for every direction in the xy-plane, the width of the section is a concave function of z. That
/// means:
///   - Both |taper| <= max_taper(epsilon) = 2^(1/epsilon) (epsilon - 1)/epsilon. This is 0.707 for epsilon = 2, and always below 1.
///   - For epsilon > 2, taper_x = taper_y. Half-way up, the side is straight along z, and two different tapers twist a straight
///   side
///     into a saddle.
///   - For epsilon <= 2 and different tapers, a bound on both together, which also depends on delta and is evaluated numerically.
///   For
///     taper_y = -taper_x = k and epsilon = 2 it is k^2 <= delta - 1, besides the first condition.
///
/// h(n) is the maximum over the height of a concave function of one variable. A safeguarded Newton iteration finds it to rounding;
/// r and H follow by implicit differentiation. At the limit of convexity the largest radius of curvature is infinite.
class SUPERNORMAL_API Superovoid final : public Shape {
 public:
  static constexpr double kMinExponent = 1.01;  ///< the smallest exponent
  static constexpr double kMaxExponent = 1000;  ///< the largest exponent

  /// Half-axes in m, finite and in [1e-30, 1e30]; exponents in [kMinExponent, kMaxExponent]; tapers with which the body is convex,
  /// see above. Throws std::invalid_argument otherwise, with the condition that fails.
  Superovoid(const Vector3& half_axes, double delta, double epsilon, double taper_x, double taper_y);

  /// The largest |taper| of a convex body with equal tapers. `epsilon` in [kMinExponent, kMaxExponent]; std::invalid_argument
  /// otherwise.
  static double max_taper(double epsilon);

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override;

  /// Where the body is flat, the normal at the moved boundary point, the gradient of the implicit function, as for the
  /// Superellipsoid.
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override;

  bool surely_contains(const Vector3& point) const override;

  /// The half-axes "a", "b" and "c", the exponents "delta" and "epsilon", and "taper_x" and "taper_y".
  void add_parameter_gradient(const Vector3& n, const Vector3& r, ParameterGradient& gradient) const override;
  /// The body extends from z = -c to c. Its widest section is above or below z = 0.
  Vector3 half_extents() const override { return half_extents_; }
  double bounding_radius() const override { return half_extents_.norm(); }
  double min_curvature_radius_estimate() const override { return min_curvature_radius_; }

  /// In closed form. With a taper the centroid is not the origin, but another point of the z-axis.
  MassProperties mass_properties() const override;

  /// m; the half-axes a, b, c of the superellipsoid without taper.
  const Vector3& half_axes() const { return half_axes_; }
  double delta() const { return delta_; }      ///< exponent of the section
  double epsilon() const { return epsilon_; }  ///< exponent of the meridian
  double taper_x() const { return taper_x_; }  ///< of the half-axis a: (1 + taper_x z/c) a
  double taper_y() const { return taper_y_; }  ///< of the half-axis b: (1 + taper_y z/c) b

 private:
  Vector3 half_axes_;
  double delta_, epsilon_;
  double taper_x_, taper_y_;
  double knee_;  // 2^(-1/epsilon): |z/c| where the meridian has the slope of its diagonal
  std::shared_ptr<const NestedNorms> norms_;
  Vector3 half_extents_;
  double min_curvature_radius_;  // m
};

}  // namespace supernormal
