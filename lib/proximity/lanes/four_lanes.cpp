#include "proximity/lanes/certified_newton_lanes.hpp"

namespace supernormal {

constinit const LaneKernel kFourLanes = {4, "4, AVX2", LaneSearch<4>::query};

}  // namespace supernormal
