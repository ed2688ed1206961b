#include "supernormal/proximity/gap_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/finite.hpp"
#include "proximity/gap/limits.hpp"
#include "shapes/superellipsoid_batch.hpp"
#include "supernormal/proximity/separation.hpp"

namespace supernormal {
namespace {

double smallest_half_extent(const Vector3& half_extents1, const Vector3& half_extents2) {
  const double smallest1 = half_extents1.minCoeff();
  const double smallest2 = half_extents2.minCoeff();
  if (smallest1 == 0) return smallest2;
  return smallest2 == 0 ? smallest1 : std::min(smallest1, smallest2);
}

}  // namespace

GapFunction::GapFunction(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2)
    : shape1_(&shape1),
      shape2_(&shape2),
      traits1_(shape1.traits()),
      traits2_(shape2.traits()),
      superellipsoid1_(as_superellipsoid(shape1)),
      superellipsoid2_(as_superellipsoid(shape2)),
      offset_(pose1.rotation.transpose() * (pose2.position - pose1.position)),
      rotation_(pose1.rotation.transpose() * pose2.rotation) {
  const Vector3 half1 = shape1.half_extents();
  const Vector3 half2 = shape2.half_extents();
  length_unit_ = smallest_half_extent(half1, half2);
  rounding_ = limits::kRoundingUnits * std::numeric_limits<double>::epsilon() *
              (offset_.norm() + shape1.bounding_radius() + shape2.bounding_radius());
}

void GapFunction::evaluate(const Vector3& n, Order order, GapJet& jet) {
  ++evaluations_;
  jet.n = n;
  jet.m.noalias() = -(rotation_.transpose() * n);
  if (superellipsoid1_ != nullptr && superellipsoid2_ != nullptr) {
    SuperellipsoidBatch::evaluate<2>({{{superellipsoid1_, &n, &jet.jet1}, {superellipsoid2_, &jet.m, &jet.jet2}}}, order);
  } else {
    shape1_->evaluate(n, order, jet.jet1);
    shape2_->evaluate(jet.m, order, jet.jet2);
  }
  jet.s = n.dot(offset_) - jet.jet1.h - jet.jet2.h;
  if (order == Order::Value) return;
  jet.d.noalias() = rotation_ * jet.jet2.r;
  jet.d += offset_ - jet.jet1.r;
}

bool GapJet::is_finite() const { return std::isfinite(s) && all_finite(d); }

bool GapFunction::is_finite() const { return all_finite(offset_) && all_finite(rotation_) && std::isfinite(length_unit_); }

double least_gap_after(const Separation& then, const Vector3& offset, const Vector3& normal_in_2, double radius1, double radius2) {
  // Both values of s have rounding errors.
  const double lengths = offset.norm() + then.offset.norm() + 2 * (radius1 + radius2);
  const double rounding = limits::kRoundingUnits * std::numeric_limits<double>::epsilon() * lengths;
  return then.gap + then.normal.dot(offset - then.offset) - radius2 * (normal_in_2 - then.normal_in_2).norm() - rounding;
}

}  // namespace supernormal
