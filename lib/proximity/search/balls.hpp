// Two balls, whose common normal is a closed form.
#pragma once

#include "supernormal/proximity/batch.hpp"

namespace supernormal {

/// The answer for balls with these radii (m), in the world's frame. It takes no evaluation. Concentric balls have any common
/// normal: the first normal of the query, or an axis of the smaller ball.
Proximity find_between_balls(const ProximityQuery& pair, double radius1, double radius2, const Settings& settings);

}  // namespace supernormal
