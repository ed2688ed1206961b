// A search on an arc for a maximum higher than the known one.
#pragma once

#include "contact/mesh/arc.hpp"

namespace supernormal {

/// Searches the whole arc from `low` to `high` for a normal with a gap above `known` (m). If there is one, `low` and `high` become
/// the samples around the highest, ready for maximize_between(). A gap less than `tolerance` (m) higher does not count.
///
/// Every point of the body bounds the gap from above for all normals: gap(n) <= n . (point - edge_point). The lower of the bounds
/// of two adjacent samples rules out most arcs without another evaluation. Otherwise its maximum is the next angle to evaluate.
bool find_higher_maximum(SupportProbe& probe, const Arc& arc, ArcSample& low, ArcSample& high, double known, double tolerance);

}  // namespace supernormal
