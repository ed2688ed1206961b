#include "shapes/lanes/four_normals.hpp"

namespace supernormal {
namespace {

EvaluateFour* widest() {
#ifdef SUPERNORMAL_WIDE_LANES
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") != 0) return evaluate_in_four_lanes;
#endif
  return evaluate_in_two_lanes;
}

}  // namespace

EvaluateFour* four_at_once() {
  static EvaluateFour* const evaluate = widest();
  return evaluate;
}

}  // namespace supernormal
