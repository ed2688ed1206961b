// The catalogue of hard cases: pairs of smooth convex bodies on which methods fail, each with its reason.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "support/hard_cases/body.hpp"

namespace supernormal::samples {

/// Two bodies in their places.
struct HardCase {
  std::string name;    ///< unique, "theme: case"
  std::string reason;  ///< why it is hard
  Body body1, body2;
  std::shared_ptr<const Shape> shape1, shape2;  ///< made of the bodies
  Pose pose1, pose2;
  std::optional<double> gap = {};            ///< m; signed, in closed form where there is one; otherwise a reference has to find it
  std::optional<Vector3> first_normal = {};  ///< unit, body 1's frame; the start of the solver
};

/// All cases, in the order of the themes.
std::vector<HardCase> hard_cases();

/// The case with the bodies exchanged.
HardCase swapped(const HardCase& original);

/// The case in another frame: x moves to motion.rotation x + motion.position.
HardCase moved(const HardCase& original, const Pose& motion);

/// The case with lengths in units of `unit` m. Throws std::invalid_argument when a length leaves the range of its shape.
HardCase scaled(const HardCase& original, double unit);

}  // namespace supernormal::samples
