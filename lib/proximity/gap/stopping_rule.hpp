// When a search ends.
#pragma once

#include <algorithm>

#include "proximity/gap/limits.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// What every loop of a query asks before it goes on: here errors are compared with the tolerance, evaluations with their limit,
/// and Settings::stop_when_apart is heeded. Only the lanes have their own comparisons (lanes/certified_newton_lanes.hpp). The loops
/// differ in the error that they offer; lib/proximity/theory.md says which errors are proved.
class StoppingRule {
 public:
  /// Keeps a reference to `gap`, whose evaluations count. The tolerance is Settings::tolerance times GapFunction::length_unit(),
  /// less the rounding error, but at least a few rounding errors.
  StoppingRule(const GapFunction& gap, const Settings& settings)
      : gap_(&gap),
        tolerance_(std::max(settings.tolerance * gap.length_unit() - gap.rounding(), limits::kFloor * gap.rounding())),
        max_evaluations_(settings.max_evaluations),
        stop_when_apart_(settings.stop_when_apart) {}

  /// `tolerance`: m; at most `max_evaluations` since `gap` was made.
  StoppingRule(const GapFunction& gap, double tolerance, int max_evaluations)
      : gap_(&gap), tolerance_(tolerance), max_evaluations_(max_evaluations) {}

  double tolerance() const { return tolerance_; }  ///< m

  /// Whether an error (m) of the gap may be left.
  bool allows(double error) const { return error <= tolerance_; }

  /// Whether an error (m) is too large. A NaN, of a shape that is known on one side only, neither is nor is allowed.
  bool forbids(double error) const { return error > tolerance_; }

  bool may_evaluate() const { return gap_->evaluations() < max_evaluations_; }

  /// Whether the bodies are proved apart, and the query asks for no more.
  bool is_apart(const GapJet& jet) const { return stop_when_apart_ && jet.s > 0; }

  /// The same rule with no more than so many evaluations since the gap function was made.
  StoppingRule with_at_most(int evaluations) const {
    StoppingRule rule = *this;
    rule.max_evaluations_ = std::min(max_evaluations_, evaluations);
    return rule;
  }

 private:
  const GapFunction* gap_;
  double tolerance_;  // m
  int max_evaluations_;
  bool stop_when_apart_ = false;
};

}  // namespace supernormal
