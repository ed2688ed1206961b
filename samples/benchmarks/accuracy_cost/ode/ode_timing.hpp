// The time that a dCollide takes.
#pragma once

#include <limits>
#include <vector>

#include "measurement.hpp"
#include "ode_poses.hpp"

namespace accuracy_cost {

/// A pair at two poses that follow one another.
struct OdeQuery {
  OdePair pair;
  bool is_warm;
  std::array<supernormal::Pose, 2> poses;
  int repeats = 2;
  // s; the shortest times of all rounds: to move the body, and to move it and call dCollide.
  double moving = std::numeric_limits<double>::infinity();
  double asking = std::numeric_limits<double>::infinity();
  double contacts = 0;  // mean

  double time() const { return asking - moving; }  // s; time of a dCollide
};

/// Measures all queries in turns, so that whatever slows the machine down slows all of them.
void measure_queries(std::vector<OdeQuery>& queries, const Effort& effort);

}  // namespace accuracy_cost
