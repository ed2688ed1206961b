#include "proximity/gap/stopping_rule.hpp"

#include "proximity/gap/limits.hpp"

namespace supernormal {

StoppingRule::StoppingRule(const GapFunction& gap, const Settings& settings)
    : gap_(&gap),
      tolerance_(std::max(settings.tolerance * gap.length_unit() - gap.rounding(), limits::kFloor * gap.rounding())),
      max_evaluations_(settings.max_evaluations),
      stop_when_apart_(settings.stop_when_apart) {}

}  // namespace supernormal
