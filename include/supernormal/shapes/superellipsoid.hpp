// Superellipsoid: from octahedron (exponents near 1) through ellipsoid (2) to box (large exponents).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "supernormal/shapes/lane_body.hpp"
#include "supernormal/shapes/power_norm.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

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
  bool has_hessian() const override { return true; }

  /// A request: a body, a unit normal, and where its jet goes.
  struct EvalRequest {
    const Superellipsoid* body;  ///< the body
    const Vector3* n;            ///< unit, in its frame
    Jet* jet;                    ///< the result
  };

  /// Evaluates two bodies in two thirds of the time of two calls of evaluate(), with the same digits.
  static void evaluate_both(const EvalRequest& request1, const EvalRequest& request2, Order order);

  /// Evaluates four normals in half of the time, with the same digits.
  static void evaluate_four(const std::array<EvalRequest, 4>& requests, Order order);
  const Superellipsoid* as_superellipsoid() const override { return this; }
  const LaneBody* lane_body() const override { return &numbers_; }

  /// Moves the boundary point and takes the normal there, the gradient of the implicit function. On a flat face r is a high power
  /// of n, so r changes steeply with n; n changes slowly with r.
  Vector3 advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const override;
  bool has_flat_faces() const override { return delta_ > 2 || epsilon_ > 2; }
  bool has_axis_aligned_faces() const override { return true; }

  bool is_round() const override { return std::min(delta_, epsilon_) >= 2 && std::max(delta_, epsilon_) <= kMostRound; }
  bool is_symmetric() const override { return true; }
  bool surely_contains(const Vector3& point) const override;
  Vector3 half_extents() const override { return half_axes_; }
  double bounding_radius() const override { return bounding_radius_; }
  double min_curvature_radius_estimate() const override;
  double rolling_radius() const override { return rolling_radius_; }
  MassProperties mass_properties() const override;

  const Vector3& half_axes() const { return half_axes_; }  ///< m; a, b and c
  double delta() const { return delta_; }                  ///< exponent of the section
  double epsilon() const { return epsilon_; }              ///< exponent of the meridian

 private:
  // With exponents up to this, the caps of a superellipsoid are wider than an ellipsoid's by at most 0.21 of the body's width.
  static constexpr double kMostRound = 3;

  template <std::size_t kCount>
  SUPERNORMAL_LOCAL static void evaluate_requests(const std::array<EvalRequest, kCount>& requests, Order order);
  SUPERNORMAL_LOCAL Vector3 along_gauge_gradient(const Vector3& gauge_point, const Vector3& signs) const;
  SUPERNORMAL_LOCAL bool is_one_norm_at(const Vector3& n) const;
  template <std::size_t kCount>
  SUPERNORMAL_LOCAL static void evaluate_by_one_norm(const std::array<EvalRequest, kCount>& requests, Order order);
  template <std::size_t kCount>
  SUPERNORMAL_LOCAL static void evaluate_by_two_norms(const std::array<EvalRequest, kCount>& requests, Order order);
  SUPERNORMAL_LOCAL void assemble(const PowerNorm3Request& norm, const Vector3& n, Order order, Jet& jet) const;
  SUPERNORMAL_LOCAL void assemble(const Vector3& n, Order order, const PowerNormJet& inner, const PowerNormJet& outer,
                                  Jet& jet) const;

  Vector3 half_axes_;
  double delta_, epsilon_;
  PowerNorm inner_support_, outer_support_;  // norms of (a nx, b ny) and of (inner, c nz): exponents p and q
  PowerNorm inner_gauge_, outer_gauge_;      // norms of (x/a, y/b) and of (inner, z/c): exponents delta and epsilon
  double rolling_radius_, bounding_radius_;  // m
  LaneBody numbers_;
};

}  // namespace supernormal
