// Whether an answer keeps its promise at a normal that is known to be high.
#pragma once

#include <algorithm>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::test {

/// n: in the world's frame
inline double gap_at(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Vector3& n) {
  GapFunction gap(shape1, pose1, shape2, pose2);
  GapJet jet;
  gap.evaluate(pose1.rotation.transpose() * n, Order::Value, jet);
  return jet.s;
}

/// Whether the maximum is proved to be the only one: the bodies are apart, touch, or overlap by less than the ball that rolls
/// inside.
inline bool must_be_proved(const GapFunction& gap, const Settings& settings, double answer) {
  const double tolerance = std::max(settings.tolerance * gap.length_unit() - gap.rounding(), 2 * gap.rounding());
  return 2 * answer >= -tolerance || answer + gap.rolling_radius() > 0;
}

}  // namespace supernormal::test
