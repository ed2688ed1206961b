#include "proximity/lanes/certified_newton_lanes.hpp"

namespace supernormal {

constinit const LaneKernel kEightLanes = {8, "8, AVX-512", LaneSearch<8>::query};

}  // namespace supernormal
