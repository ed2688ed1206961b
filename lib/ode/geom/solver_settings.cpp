#include "ode/geom/solver_settings.hpp"

#include <algorithm>
#include <mutex>

namespace supernormal::ode {
namespace {

std::mutex default_mutex;
Settings default_value;

}  // namespace

Settings default_settings() {
  const std::lock_guard lock(default_mutex);
  return default_value;
}

void set_default_settings(const Settings& settings) {
  const std::lock_guard lock(default_mutex);
  default_value = settings;
}

Settings combined(const Settings& settings1, const Settings& settings2) {
  Settings both;
  both.solver = settings1.solver == settings2.solver ? settings1.solver : Solver::Hybrid;
  both.tolerance = std::min(settings1.tolerance, settings2.tolerance);
  both.max_evaluations = std::max(settings1.max_evaluations, settings2.max_evaluations);
  return both;
}

}  // namespace supernormal::ode
