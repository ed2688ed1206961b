// Solver settings of one geom, the defaults of new geoms, and the counters of this thread.
#include <stdexcept>
#include <string>

#include "ode/geom/body.hpp"
#include "ode/runtime/statistics.hpp"
#include "ode/runtime/warm_start.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "proximity/gap/usable_settings.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

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
  return require_in_range({to_solver(solver), tolerance, max_evaluations});
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snGeomSetSolver(dGeomID geom, snSolver solver, dReal tolerance, int max_evaluations) {
  return succeeds("snGeomSetSolver", [&] { require_body(geom).set_settings(to_settings(solver, tolerance, max_evaluations)); });
}

extern "C" int snSetDefaultSolver(snSolver solver, dReal tolerance, int max_evaluations) {
  return succeeds("snSetDefaultSolver", [&] { set_default_settings(to_settings(solver, tolerance, max_evaluations)); });
}

extern "C" void snSetWarmStart(int on) { set_warm_start(on != 0); }

extern "C" void snGetStatistics(snStatistics* out) {
  succeeds("snGetStatistics", [&] {
    require_not_null("out", out);
    *out = thread_statistics();
  });
}

extern "C" void snResetStatistics(void) { exchange_statistics({}); }
