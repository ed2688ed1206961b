#include "supernormal/proximity/separation.hpp"

#include <limits>

#include "proximity/gap/limits.hpp"

namespace supernormal {

double least_gap_after(const Separation& then, const Vector3& offset, const Vector3& normal_in_2, double radius1, double radius2) {
  // Both values of s have rounding errors.
  const double lengths = offset.norm() + then.offset.norm() + 2 * (radius1 + radius2);
  const double rounding = limits::kRoundingUnits * std::numeric_limits<double>::epsilon() * lengths;
  return then.gap + then.normal.dot(offset - then.offset) - radius2 * (normal_in_2 - then.normal_in_2).norm() - rounding;
}

}  // namespace supernormal
