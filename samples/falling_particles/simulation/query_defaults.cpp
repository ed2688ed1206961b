#include "query_defaults.hpp"

#include <stdexcept>

namespace falling_particles {
namespace {

void set(const Query& query) {
  if (snSetDefaultSolver(query.solver, query.tolerance, query.max_evaluations) == 0) throw std::runtime_error(snLastError());
  snSetWarmStart(query.warm_start ? 1 : 0);
}

}  // namespace

QueryDefaults::QueryDefaults(const std::optional<Query>& query) : are_changed_(query.has_value()) {
  if (are_changed_) set(*query);
}

QueryDefaults::~QueryDefaults() {
  if (are_changed_) set({});
}

}  // namespace falling_particles
