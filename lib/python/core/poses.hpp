// Poses in Python programs.
#pragma once

#include <vector>

#include "supernormal/proximity/pose.hpp"

namespace supernormal::python {

/// N poses; Python: Poses.
struct Poses {
  std::vector<Pose> poses;
};

}  // namespace supernormal::python
