// Measures the time of dCollide.
#pragma once

#include <limits>
#include <vector>

#include "measurement.hpp"
#include "ode_poses.hpp"

namespace accuracy_cost {

/// A pair at two consecutive poses.
struct OdeQuery {
  OdePair pair;
  bool is_warm;
  std::array<supernormal::Pose, 2> poses;
  int repeats = 2;
  // The shortest times of all rounds, s: to move the body, and to move it and call dCollide.
  double moving = std::numeric_limits<double>::infinity();
  double asking = std::numeric_limits<double>::infinity();
  double contacts = 0;  // mean

  double time() const { return asking - moving; }  // s; of dCollide
};

/// Measures all queries in turns, so that a disturbance of the machine affects all of them.
void measure_queries(std::vector<OdeQuery>& queries, const Effort& effort);

}  // namespace accuracy_cost
