#include "query.hpp"

#include "base/interval.hpp"

namespace falling_particles {

std::string name_of(snSolver solver) {
  return solver == SN_SOLVER_HYBRID ? "hybrid" : solver == SN_SOLVER_NEWTON ? "newton" : "fixed_point";
}

std::optional<Query> load_query(const TomlTable& root) {
  const auto table = root.find_table("query", {"solver", "tolerance", "max_evaluations", "warm_start"});
  if (!table) return std::nullopt;
  Query query;
  if (table->has("solver")) {
    const std::string word =
        table->choice("solver", {name_of(SN_SOLVER_HYBRID), name_of(SN_SOLVER_NEWTON), name_of(SN_SOLVER_FIXED_POINT)});
    for (const snSolver solver : {SN_SOLVER_NEWTON, SN_SOLVER_FIXED_POINT}) {
      if (word == name_of(solver)) query.solver = solver;
    }
  }
  if (table->has("tolerance")) query.tolerance = table->number("tolerance", Interval::closed(1e-15, 1, ""));
  if (table->has("max_evaluations")) query.max_evaluations = static_cast<int>(table->integer("max_evaluations", 1, 1000000));
  if (table->has("warm_start")) query.warm_start = table->boolean("warm_start");
  return query;
}

}  // namespace falling_particles
