// Whether an answer keeps its promise at a normal that is known to be high.
#pragma once

#include <doctest/doctest.h>

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

/// The proved interval must cover the gap at this normal, and where the maximum must be proved the answer has converged to it; body
/// 1 is at the origin.
inline void check_covers(const Shape& body1, const Shape& body2, const Pose& pose2, const Vector3& higher,
                         const Settings& settings = {}, const Vector3* first_normal = nullptr) {
  const Proximity answer = find_proximity(body1, {}, body2, pose2, settings, first_normal);
  CHECK(gap_at(body1, {}, body2, pose2, higher) <= answer.gap + answer.global_error);
  if (!must_be_proved(GapFunction(body1, {}, body2, pose2), settings, answer.gap)) return;
  CHECK(answer.status == Status::Converged);
  CHECK(answer.is_global);
}

}  // namespace supernormal::test
