#include "ode/runtime/solver_settings.hpp"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <string>

#include "ode/api/last_error.hpp"
#include "ode/api/require.hpp"
#include "ode/geom/body.hpp"
#include "ode/runtime/warm_start.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

std::mutex default_mutex;
Settings default_value;

Solver to_solver(snSolver solver) {
  switch (solver) {
    case SN_SOLVER_HYBRID:
      return Solver::Hybrid;
    case SN_SOLVER_NEWTON:
      return Solver::Newton;
    case SN_SOLVER_FIXED_POINT:
      return Solver::FixedPoint;
  }
  throw std::invalid_argument("solver = " + std::to_string(static_cast<int>(solver)) +
                              " is none of SN_SOLVER_HYBRID (0), SN_SOLVER_NEWTON (1), SN_SOLVER_FIXED_POINT (2)");
}

Settings to_settings(snSolver solver, dReal tolerance, int max_evaluations) {
  Settings settings;
  settings.solver = to_solver(solver);
  settings.tolerance = require_in("tolerance", tolerance, 1e-15, 1);
  if (max_evaluations < 1 || max_evaluations > 1000000) {
    throw std::invalid_argument("max_evaluations = " + std::to_string(max_evaluations) + " is outside [1, 1000000]");
  }
  settings.max_evaluations = max_evaluations;
  return settings;
}

}  // namespace

Settings default_settings() {
  const std::lock_guard lock(default_mutex);
  return default_value;
}

Settings combined(const Settings& settings1, const Settings& settings2) {
  Settings both;
  both.solver = settings1.solver == settings2.solver ? settings1.solver : Solver::Hybrid;
  both.tolerance = std::min(settings1.tolerance, settings2.tolerance);
  both.max_evaluations = std::max(settings1.max_evaluations, settings2.max_evaluations);
  return both;
}

}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snGeomSetSolver(dGeomID geom, snSolver solver, dReal tolerance, int max_evaluations) {
  return guarded("snGeomSetSolver", 0, [&] {
    require_body(geom).set_settings(to_settings(solver, tolerance, max_evaluations));
    return 1;
  });
}

extern "C" int snSetDefaultSolver(snSolver solver, dReal tolerance, int max_evaluations) {
  return guarded("snSetDefaultSolver", 0, [&] {
    const auto settings = to_settings(solver, tolerance, max_evaluations);
    const std::lock_guard lock(default_mutex);
    default_value = settings;
    return 1;
  });
}

extern "C" void snSetWarmStart(int on) { set_warm_start(on != 0); }
