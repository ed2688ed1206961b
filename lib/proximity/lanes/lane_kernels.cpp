#include "proximity/lanes/pair_query.hpp"

namespace supernormal {
namespace {

LaneKernels available() {
  LaneKernels all{{&kOneLane, &kTwoLanes}, 2};
#ifdef SUPERNORMAL_WIDE_LANES
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") != 0) all.kernels[all.count++] = &kFourLanes;
  if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
      __builtin_cpu_supports("avx512vl") != 0) {
    all.kernels[all.count++] = &kEightLanes;
  }
#endif
  return all;
}

}  // namespace

const LaneKernels& lane_kernels() {
  static const LaneKernels kernels = available();
  return kernels;
}

}  // namespace supernormal
