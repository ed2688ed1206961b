#include "proximity/lanes/certified_newton_lanes.hpp"

namespace supernormal {

constinit const LaneKernel kTwoLanes = {2, "2 lanes", LaneSearch<2>::query};

}  // namespace supernormal
