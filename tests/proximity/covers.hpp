// A check that a normal that is known to be higher is within the interval that an answer proves.
#pragma once

#include <doctest/doctest.h>

#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::test {

/// The gap function at the normal n, which is in the world's frame.
inline double gap_at(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Vector3& n) {
  GapFunction gap(shape1, pose1, shape2, pose2);
  GapJet jet;
  gap.evaluate(pose1.rotation.transpose() * n, Order::Value, jet);
  return jet.s;
}

/// The proved interval must cover the gap at this normal; body 1 is at the origin.
inline void check_covers(const Shape& body1, const Shape& body2, const Pose& pose2, const Vector3& higher,
                         const Settings& settings = {}, const Vector3* first_normal = nullptr) {
  const Proximity answer = find_proximity(body1, {}, body2, pose2, settings, first_normal);
  CHECK(gap_at(body1, {}, body2, pose2, higher) <= answer.gap + answer.global_error);
}

}  // namespace supernormal::test
