#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iterator>
#include <stdexcept>

#include "costs.hpp"
#include "measurement.hpp"
#include "supernormal/supernormal.h"

namespace accuracy_cost {
namespace {

using common::MeasuredTable;
using supernormal::Solver;

// Decimal exponents of the tightest tolerances. Ours is relative; the tolerance of libccd is in metres, for bodies of about one
// metre. With a tighter one EPA cycles for ever, since it has no iteration limit.
constexpr int kOurTightest = 14;
constexpr int kEpaTightest = 7;
constexpr int kMprTightest = 10;

constexpr const char* kHeader =
    "class,pose,method,accuracy,queries,time_s,time_p99_s,evaluations,gap_error,gap_error_p99,gap_error_worst,normal_error,"
    "contact_error,failures,inexact,no_answer,wrong_verdict,wrong_gap";

void add(Methods& methods, Methods&& more) { std::move(more.begin(), more.end(), std::back_inserter(methods)); }

void add_sweep(Methods& methods, int tightest, const std::function<std::unique_ptr<Method>(double tolerance)>& make) {
  for (int digits = 1; digits <= tightest; ++digits) methods.push_back(make(std::pow(10.0, -digits)));
}

Methods all_methods() {
  Methods methods;
  const auto ours = [](const char* name, Solver solver, Start start) {
    return [=](double tolerance) { return supernormal_method(name, solver, start, tolerance); };
  };
  add_sweep(methods, kOurTightest, ours("hybrid", Solver::Hybrid, Start::Cold));
  add_sweep(methods, kOurTightest, ours("hybrid (warm)", Solver::Hybrid, Start::Warm));
  add_sweep(methods, kOurTightest, ours("Newton (Algorithm I)", Solver::Newton, Start::Cold));
  add_sweep(methods, kOurTightest, ours("fixed point (Algorithm II)", Solver::FixedPoint, Start::Cold));
  methods.push_back(early_out("hybrid (early out)", Start::Cold));
  methods.push_back(early_out("hybrid (early out; warm)", Start::Warm));
  add_sweep(methods, kEpaTightest, [](double tolerance) { return ccd_epa("libccd GJK+EPA", tolerance); });
  add_sweep(methods, kMprTightest, [](double tolerance) { return ccd_mpr("libccd MPR", tolerance); });
  add(methods, bullet_methods());
  return methods;
}

/// All literature methods, and ours at the same tolerances.
Methods compared_with_literature() {
  if (snInit() == 0) throw std::runtime_error(snLastError());
  Methods methods;
  for (const Start start : {Start::Cold, Start::Warm}) {
    const std::string warm = start == Start::Warm ? " (warm)" : "";
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
      methods.push_back(supernormal_method("hybrid" + warm, Solver::Hybrid, start, tolerance));
      methods.push_back(supernormal_method("Newton (Algorithm I)" + warm, Solver::Newton, start, tolerance));
      methods.push_back(supernormal_method("fixed point (Algorithm II)" + warm, Solver::FixedPoint, start, tolerance));
      add(methods, literature_methods(start, tolerance));
    }
  }
  methods.push_back(ccd_epa("libccd GJK+EPA", 1e-6));
  methods.push_back(ccd_mpr("libccd MPR", 1e-4));
  add(methods, bullet_methods());
  add(methods, literature_mesh_methods());
  return methods;
}

std::string line(const Method& method, BodyClass body_class, Situation situation, const Statistics& s) {
  std::array<char, 512> text{};
  std::snprintf(text.data(), text.size(), "%c,%c,\"%s\",%s,%zu,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%zu,%zu,%zu,%zu,%zu",
                letter(body_class), letter(situation), method.name().c_str(), method.accuracy().c_str(), s.queries, s.time,
                s.slow_time, s.evaluations, s.median_error, s.large_error, s.worst_error, s.normal_error, s.contact_error,
                s.failures(), s.inexact, s.no_answer, s.wrong_verdict, s.wrong_gap);
  return text.data();
}

using MethodsOf = std::function<Methods()>;

MeasuredTable table_of(const std::string& name, std::size_t pair_count, std::uint64_t seed, const Effort& effort,
                       const MethodsOf& methods_of) {
  MeasuredTable table{name, kHeader, {}};
  for (const BodyClass body_class : kAllBodyClasses) {
    for (const Situation situation : kAllSituations) {
      table.tasks.push_back({std::string{letter(body_class), letter(situation)}, [=] {
                               std::vector<Pair> pairs = draw_pairs_of(body_class, situation, pair_count, seed);
                               const Methods methods = methods_of();
                               const auto samples = measure(methods, pairs, effort);
                               improve_references(samples, pairs);
                               std::vector<std::string> lines;
                               lines.reserve(methods.size());
                               for (std::size_t m = 0; m < methods.size(); ++m) {
                                 lines.push_back(line(*methods[m], body_class, situation, statistics(samples[m], pairs)));
                               }
                               return lines;
                             }});
    }
  }
  return table;
}

}  // namespace

MeasuredTable query_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort) {
  return table_of("query", pairs, seed, effort, all_methods);
}

MeasuredTable literature_costs(std::size_t pairs, std::uint64_t seed, const Effort& effort) {
  return table_of("literature", pairs, seed, effort, compared_with_literature);
}

}  // namespace accuracy_cost
