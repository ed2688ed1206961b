#include "proximity/stopping_rule.hpp"

namespace supernormal {
namespace {

// A bound is the length of a vector, less s. The vector's three components have the rounding of s each, so the bound cannot fall
// below about three rounding errors.
constexpr double kFloor = 4;

}  // namespace

StoppingRule::StoppingRule(const GapFunction& gap, const Settings& settings)
    : gap_(&gap),
      tolerance_(std::max(settings.tolerance * gap.length_unit() - gap.rounding(), kFloor * gap.rounding())),
      max_evaluations_(settings.max_evaluations),
      stop_when_apart_(settings.stop_when_apart) {}

}  // namespace supernormal
