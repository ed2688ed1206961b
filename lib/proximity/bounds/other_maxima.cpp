#include "proximity/bounds/other_maxima.hpp"

namespace supernormal {
namespace {

// Blaschke's theorem is certain up to a depth of one radius. In random pairs (exponents 6...200) no second maximum won below four
// radii at overlaps of up to 10 %, so shallow queries are spared the search; at 30 % three radii miss 1.2 % of the boxes, two 0.15
// %. Where the centre of one body is about that of the other, all the ways out are of like length and nothing is spared.
constexpr double kShallowDepthPerRadius = 4;
constexpr double kDeepDepthPerRadius = 2;
constexpr double kCertainDepthPerRadius = 1;
constexpr double kDeep = 0.15;         // of the smallest half-extent
constexpr double kAboutCentred = 0.5;  // likewise

}  // namespace

bool may_have_other_maxima(double radius1, double radius2, double depth, double length_unit, bool may_have_tips) {
  const double radii = may_have_tips || depth > kAboutCentred * length_unit ? kCertainDepthPerRadius
                       : depth > kDeep * length_unit                        ? kDeepDepthPerRadius
                                                                            : kShallowDepthPerRadius;
  return depth > radii * (radius1 + radius2);
}

}  // namespace supernormal
