// A body that the program describes by functions.
#pragma once

#include <functional>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A convex body given by its support function and boundary point, and its Hessian if the program has it. In C++ a class derived
/// from Shape does the same. This class is for functions from elsewhere, such as the C interface.
class SUPERNORMAL_API CallbackShape final : public Shape {
 public:
  using Support = std::function<double(const Vector3& n)>;   ///< h(n), m
  using Point = std::function<Vector3(const Vector3& n)>;    ///< r(n), m
  using Hessian = std::function<Matrix3(const Vector3& n)>;  ///< H(n), m

  /// `hessian` may be empty. The functions are tested in 26 directions, to the faces, edges and vertices of a cube. The conditions
  /// are:
  ///   - the results are finite, and the size is in [1e-30, 1e30] m;
  ///   - |n.r - h| <= 1e-6 of the size, and h(n) + h(-n) >= 2e-30 m;
  ///   - no point is farther than 1e-6 of the size outside a supporting plane;
  ///   - the Hessian is symmetric, H n = 0, and no radius is negative, all to 1e-6 of its largest entry.
  ///
  /// Throws std::invalid_argument otherwise, with the direction, the value and the condition. About 650 more directions estimate
  /// the body's sharpest edges.
  CallbackShape(Support support, Point point, Hessian hessian = {});

  /// Without a Hessian, Order::Hessian delivers h and r and leaves H unchanged.
  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  ShapeTraits traits() const override { return {.has_hessian = static_cast<bool>(hessian_)}; }
  Vector3 half_extents() const override { return half_extents_; }
  double bounding_radius() const override { return bounding_radius_; }

  /// An estimate from boundary points. Solvers need it as a measure of the body's sharpness. It may miss an edge that is off the
  /// nine sampled great circles and shorter than the distance between two of them.
  double min_curvature_radius_estimate() const override { return min_curvature_radius_; }

 private:
  Support support_;
  Point point_;
  Hessian hessian_;
  Vector3 half_extents_;  // computed once, like the next two
  double bounding_radius_;
  double min_curvature_radius_;
};

}  // namespace supernormal
