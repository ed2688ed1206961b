// The convex hull of some points.
#pragma once

#include <array>
#include <span>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The convex hull of points: a point, a segment, a triangle or a solid, h(n) = max n.v. Points inside the hull, coplanar and
/// repeated points do no harm. It only looks at the points, which the caller keeps: nothing is copied or allocated, so that one can
/// be made for a query. The origin of the frame should be near the middle of the points: solvers start from there.
class SUPERNORMAL_API Polytope final : public Shape {
 public:
  /// `points` in m, at least one, finite and within 1e30; std::invalid_argument otherwise. `face_normals` (unit) are where solvers
  /// look for other maxima when bodies overlap deeply: those of the faces, as many as are known; may be empty.
  explicit Polytope(std::span<const Vector3> points, std::span<const Vector3> face_normals = {});

  void evaluate(const Vector3& n, Order order, Jet& jet) const override;
  bool has_kinks() const override { return points_.size() > 1; }
  void add_corners(const Vector3& n, const Vector3& toward, Corners& corners) const override;
  Vector3 half_extents() const override { return half_extents_; }
  double sharpest_radius() const override;

  /// Exact, but for points that lie less than about a millionth of the size outside the hull of the others: what they hold may be
  /// missing, and relative_error counts it.
  MassProperties mass_properties() const override;

  std::span<const Vector3> points() const { return points_; }

  /// As given; of a triangle, that of its two sides.
  std::span<const Vector3> face_normals() const override {
    return face_normals_.empty() ? std::span(sides_).first(side_count_) : face_normals_;
  }

 private:
  std::span<const Vector3> points_;
  std::span<const Vector3> face_normals_;
  std::array<Vector3, 2> sides_;
  std::size_t side_count_ = 0;
  Vector3 half_extents_;
};

}  // namespace supernormal
