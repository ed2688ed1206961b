// The catalogue of hard cases as a table: each solver's answer, its cost, and its distance from the reference.
//
//     hard_cases [--filter text] [--reasons] [--tolerance 1e-9] [--max-evaluations 1000] [--certify]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "invariants.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace {

using namespace supernormal;
using namespace supernormal::samples;

struct Options {
  std::string filter;
  bool reasons = false;
  Settings settings;
};

struct NamedSolver {
  Solver solver;
  const char* name;
};

constexpr std::array kSolvers = {NamedSolver{Solver::Hybrid, "hybrid"}, NamedSolver{Solver::Newton, "Newton (I)"},
                                 NamedSolver{Solver::FixedPoint, "fixed point (II)"}};

/// The comparison of an answer with the reference.
enum class Verdict {
  Right,       ///< converged, and within its error of the reference
  Local,       ///< converged, lower than the reference, and claims only a local maximum
  Unfinished,  ///< reports that it has not converged
  Wrong,       ///< converged, but farther from the reference than its error
};

const char* name_of(Status status) {
  switch (status) {
    case Status::Converged:
      return "converged";
    case Status::Apart:
      return "apart";
    case Status::Stalled:
      return "stalled";
    case Status::EvaluationLimit:
      return "limit";
    case Status::Diverged:
      return "diverged";
    case Status::InvalidInput:
      break;
  }
  return "no answer";
}

/// Newton and fixed point are for smooth bodies; the library solves all other cases with the hybrid.
bool is_answered(const HardCase& one, Solver solver) {
  if (solver == Solver::Hybrid) return true;
  if (one.shape1->traits().has_nonsmooth_points || one.shape2->traits().has_nonsmooth_points) return false;
  return solver == Solver::FixedPoint || (one.shape1->traits().has_hessian && one.shape2->traits().has_hessian);
}

Verdict judge(const HardCase& one, const Settings& settings, const Proximity& answer, const Reference& reference) {
  if (answer.status != Status::Converged) return Verdict::Unfinished;
  if (reference.distance(answer.gap) <= error_of(one, settings, answer) + rounding_of(one)) return Verdict::Right;
  return answer.is_global || answer.gap > reference.upper ? Verdict::Wrong : Verdict::Local;
}

struct Tally {
  int right = 0, local = 0, unfinished = 0, wrong = 0;
  std::vector<int> evaluations;

  void count(Verdict verdict) {
    ++(verdict == Verdict::Right ? right : verdict == Verdict::Local ? local : verdict == Verdict::Unfinished ? unfinished : wrong);
  }
};

void print_cell(const HardCase& one, const Options& options, Solver solver, const Reference& reference, Tally& tally) {
  if (!is_answered(one, solver)) {
    std::printf(" | %-29s", "-");
    return;
  }
  Settings settings = options.settings;
  settings.solver = solver;
  Violations exceptions;
  const Proximity answer = solve(one, settings, exceptions);
  const Verdict verdict = judge(one, settings, answer, reference);
  tally.count(verdict);
  tally.evaluations.push_back(answer.evaluations);
  const double unit = GapFunction(*one.shape1, one.pose1, *one.shape2, one.pose2).length_unit();
  const char* mark = verdict == Verdict::Wrong ? "WRONG" : verdict == Verdict::Local ? "local" : "";
  std::printf(" | %4d %8.1e %-9s %-5s", answer.evaluations, reference.distance(answer.gap) / unit, name_of(answer.status), mark);
}

void print_summary(const std::array<Tally, kSolvers.size()>& tallies) {
  std::printf("\n%-16s  %6s  %14s  %18s  %6s  %18s  %8s\n", "solver", "right", "a local maximum", "says it has failed", "wrong",
              "median evaluations", "most");
  for (std::size_t k = 0; k < kSolvers.size(); ++k) {
    std::vector<int> evaluations = tallies[k].evaluations;
    std::sort(evaluations.begin(), evaluations.end());
    std::printf("%-16s  %6d  %14d  %18d  %6d  %18d  %8d\n", kSolvers[k].name, tallies[k].right, tallies[k].local,
                tallies[k].unfinished, tallies[k].wrong, evaluations.empty() ? 0 : evaluations[evaluations.size() / 2],
                evaluations.empty() ? 0 : evaluations.back());
  }
}

void print_table(const Options& options) {
  std::printf(
      "Each solver: evaluations, error against the reference in units of the smallest half-extent, status; \"-\": it has no\n"
      "answer of its own to bodies with kinks, or without a Hessian.\n\n");
  std::printf("%-76s | %12s", "case", "gap, m");
  for (const NamedSolver& named : kSolvers) std::printf(" | %-29s", named.name);
  std::printf("\n");
  std::array<Tally, kSolvers.size()> tallies;
  for (const HardCase& one : hard_cases()) {
    if (one.name.find(options.filter) == std::string::npos) continue;
    const Reference reference = find_reference(one);
    std::printf("%-76s | %12.5g", one.name.c_str(), reference.lower);
    for (std::size_t k = 0; k < kSolvers.size(); ++k) print_cell(one, options, kSolvers[k].solver, reference, tallies[k]);
    std::printf("\n");
    if (options.reasons) {
      std::printf("    %s\n    %s\n    %s\n", one.reason.c_str(), describe(one.body1).c_str(), describe(one.body2).c_str());
    }
  }
  print_summary(tallies);
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app("The three solvers on the catalogue of hard cases");
  app.add_option("--filter", options.filter, "only the cases whose name contains this");
  app.add_flag("--reasons", options.reasons, "why each case is hard, and its bodies");
  app.add_option("--tolerance", options.settings.tolerance, "of the gap, relative to the smallest half-extent")
      ->check(CLI::Range(1e-15, 1.));
  app.add_option("--max-evaluations", options.settings.max_evaluations, "of the gap function")->check(CLI::Range(1, 1000000));
  app.add_flag("--certify", options.settings.certify_depth, "let the hybrid prove that the depth is the smallest");
  CLI11_PARSE(app, argc, argv);
  print_table(options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "hard_cases: %s\n", error.what());
    return 2;
  }
}
