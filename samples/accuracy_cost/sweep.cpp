#include "sweep.hpp"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "environment.hpp"
#include "statistics.hpp"

namespace accuracy_cost {
namespace {

using supernormal::Solver;

// Exponents of ten: of our tolerance, which is relative, and of libccd's, which is in metres for bodies of about a metre. With
// less than that EPA goes round in circles, and it has no limit of iterations.
constexpr int kLoosest = -1;
constexpr int kOurTightest = -14;
constexpr int kEpaTightest = -7;
constexpr int kMprTightest = -10;

struct Sweep {
  Methods methods;
  std::vector<int> exponents;  // of their tolerances

  void add(int tightest, const std::function<std::unique_ptr<Method>(double tolerance)>& make) {
    for (int exponent = kLoosest; exponent >= tightest; --exponent) {
      methods.push_back(make(std::pow(10.0, exponent)));
      exponents.push_back(exponent);
    }
  }
};

Sweep all_methods() {
  Sweep sweep;
  const auto ours = [](const char* name, Solver solver, Start start) {
    return [=](double tolerance) { return supernormal_method(name, solver, start, tolerance); };
  };
  sweep.add(kOurTightest, ours("hybrid", Solver::Hybrid, Start::Cold));
  sweep.add(kOurTightest, ours("hybrid (warm)", Solver::Hybrid, Start::Warm));
  sweep.add(kOurTightest, ours("Newton (Algorithm I)", Solver::Newton, Start::Cold));
  sweep.add(kOurTightest, ours("fixed point (Algorithm II)", Solver::FixedPoint, Start::Cold));
  sweep.add(kEpaTightest, [](double tolerance) { return ccd_epa("libccd GJK+EPA", tolerance); });
  sweep.add(kMprTightest, [](double tolerance) { return ccd_mpr("libccd MPR", tolerance); });
  return sweep;
}

void write_line(const Method& method, int exponent, BodyClass body_class, Situation situation, const Statistics& s,
                std::ofstream& file) {
  char numbers[256];
  std::snprintf(numbers, sizeof numbers, "1e%d,%zu,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%zu", exponent, s.queries, s.time,
                s.slow_time, s.evaluations, s.median_error, s.large_error, s.worst_error, s.normal_error, s.failures);
  file << letter(body_class) << ',' << letter(situation) << ",\"" << method.name() << "\"," << numbers << '\n';
}

}  // namespace

void write_sweep(std::size_t pair_count, std::uint64_t seed, const Effort& effort, const std::string& path) {
  std::ofstream file(path);
  for (const auto& [name, value] : environment()) file << "# " << name << ": " << value << "\n";
  file << "class,pose,method,tolerance,queries,time_s,time_p99_s,evaluations,gap_error,gap_error_p99,gap_error_worst,normal_error,"
          "failures\n";
  std::vector<Pair> pairs = draw_pairs(pair_count, seed);
  const Sweep sweep = all_methods();
  const auto samples = measure(sweep.methods, pairs, effort);
  improve_references(samples, pairs);
  for (const BodyClass body_class : kBodyClasses) {
    for (const Situation situation : kSituations) {
      const auto is_chosen = [=](const Pair& pair) { return pair.body_class == body_class && pair.situation == situation; };
      for (std::size_t m = 0; m < sweep.methods.size(); ++m) {
        write_line(*sweep.methods[m], sweep.exponents[m], body_class, situation, statistics(samples[m], pairs, is_chosen), file);
      }
    }
  }
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace accuracy_cost
