#include "environment.hpp"

#include <ode/ode.h>

namespace accuracy_cost {

common::Environment environment() {
  common::Environment lines = common::environment();
  lines.emplace_back("ODE", dODE_VERSION);
  lines.emplace_back("libccd (by its ccd.pc)", ACCURACY_COST_CCD_VERSION);
#ifdef ACCURACY_COST_BULLET_VERSION
  lines.emplace_back("Bullet", ACCURACY_COST_BULLET_VERSION);
#else
  lines.emplace_back("Bullet", "missing at the build: not measured");
#endif
  return lines;
}

}  // namespace accuracy_cost
