// A search for a higher maximum on an arc than the known one.
#pragma once

#include "contact/mesh/arc.hpp"

namespace supernormal {

/// Searches the whole arc, of which `low` and `high` are the ends, for a normal with a gap above `known` (m). If there is one,
/// puts the two samples around the highest into `low` and `high`, ready for maximize_between(). Gaps that are less than
/// `tolerance` (m) higher do not count.
///
/// Every point of the body bounds the gap from above, for all normals: gap(n) <= n . (point - edge_point). Between two samples
/// the lower of their two bounds rules most arcs out without another evaluation, and otherwise gives the angle to evaluate next.
bool find_higher_maximum(SupportProbe& probe, const Arc& arc, ArcSample& low, ArcSample& high, double known, double tolerance);

}  // namespace supernormal
