#include "proximity/bounds/other_maxima.hpp"

#include "proximity/tuning.hpp"

namespace supernormal {

bool may_have_other_maxima(double min_radii, double depth) { return depth > kTuning.depth_per_radius * min_radii; }

}  // namespace supernormal
