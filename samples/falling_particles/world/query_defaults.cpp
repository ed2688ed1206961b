#include "query_defaults.hpp"

#include <stdexcept>

namespace falling_particles {
namespace {

bool set(const Query& query) {
  if (snSetDefaultSolver(query.solver, query.tolerance, query.max_evaluations) == 0) return false;
  snSetWarmStart(query.warm_start ? 1 : 0);
  return true;
}

}  // namespace

QueryDefaults::QueryDefaults(const std::optional<Query>& query) : are_changed_(query.has_value()) {
  if (are_changed_ && !set(*query)) throw std::runtime_error(snLastError());
}

QueryDefaults::~QueryDefaults() {
  if (are_changed_) set({});  // the defaults are never refused
}

}  // namespace falling_particles
