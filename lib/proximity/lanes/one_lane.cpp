#include "proximity/lanes/certified_newton_lanes.hpp"

namespace supernormal {

constinit const LaneKernel kOneLane = {1, "one lane", LaneSearch<1>::query};

}  // namespace supernormal
