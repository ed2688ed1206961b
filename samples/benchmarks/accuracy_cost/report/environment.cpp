#include "environment.hpp"

#include <ode/ode.h>

#include "methods/method.hpp"

namespace accuracy_cost {

common::Environment environment() {
  common::Environment lines = common::environment();
  lines.emplace_back("ODE", dODE_VERSION);
  lines.emplace_back("libccd (by its ccd.pc)", ACCURACY_COST_CCD_VERSION);
  for (const Library& library : libraries()) {
    lines.emplace_back(library.name, library.version.empty() ? "missing at the build: not measured" : library.version);
  }
  return lines;
}

}  // namespace accuracy_cost
