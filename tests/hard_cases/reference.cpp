#include "reference.hpp"

#include <algorithm>

#include "proximity/collider_reference.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal::samples {

double Reference::distance(double gap) const { return std::max({lower - gap, gap - upper, 0.}); }

Reference find_reference(const HardCase& one) { return one.gap ? Reference{*one.gap, *one.gap} : enclose_gap(one); }

Reference enclose_gap(const HardCase& one, int max_evaluations) {
  const GapFunction gap(*one.shape1, one.pose1, *one.shape2, one.pose2);
  const double width = std::max(1e-12 * gap.length_unit(), gap.rounding());
  const test::GapBounds bounds = test::bound_gap(*one.shape1, one.pose1, *one.shape2, one.pose2, width, max_evaluations);
  return {bounds.lower, bounds.upper};
}

}  // namespace supernormal::samples
