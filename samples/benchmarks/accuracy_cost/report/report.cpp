#include "report.hpp"

#include <fstream>
#include <stdexcept>

#include "common/number_text.hpp"
#include "environment.hpp"
#include "statistics.hpp"

namespace accuracy_cost {
namespace {

using common::number;
using common::text;
using Group = std::function<bool(const Pair&)>;

Group group_of(BodyClass body_class, Situation situation) {
  return [=](const Pair& pair) { return pair.body_class == body_class && pair.situation == situation; };
}

Statistics of_method(const Results& results, const std::string& name, const Group& group) {
  for (std::size_t m = 0; m < results.methods.size(); ++m) {
    if (results.methods[m]->name() == name) return statistics(results.samples[m], results.pairs, group);
  }
  throw std::logic_error("no method " + name);
}

double time_per_evaluation(const Results& results, const char* order, const Group& group) {
  return of_method(results, order, group).time / static_cast<double>(kNormalsPerPair);
}

void write_methods(const Results& results, std::ostream& out) {
  out << "| class | pose | method | time µs | evaluations | median error | worst error | off by > 1e-6 | failures |\n"
         "|---|---|---|---:|---:|---:|---:|---:|---:|\n";
  for (const BodyClass body_class : kBodyClasses) {
    for (const Situation situation : kSituations) {
      for (std::size_t m = 0; m < results.methods.size(); ++m) {
        if (is_unit_of_cost(*results.methods[m])) continue;
        const Statistics s = statistics(results.samples[m], results.pairs, group_of(body_class, situation));
        out << "| " << letter(body_class) << " | " << letter(situation) << " | " << results.methods[m]->name() << " | "
            << text("%.3f", s.time * 1e6) << " | " << text("%.3g", s.evaluations) << " | " << text("%.1e", s.median_error) << " | "
            << text("%.1e", s.worst_error) << " | " << s.inexact << " | " << s.failures() << "/" << s.queries << " |\n";
      }
    }
  }
}

void write_ratio_row(const Results& results, const std::string& label, const Group& group, std::ostream& out) {
  const Statistics hybrid = of_method(results, kHybrid, group);
  const double epa = of_method(results, kCcdEpa, group).time;
  const double evaluation = time_per_evaluation(results, kCurvatureCost, group);
  out << "| " << label << " | " << text("%.1f", epa / hybrid.time) << " | "
      << text("%.1f", epa / of_method(results, kHybridWarm, group).time) << " | "
      << text("%.1f", epa / of_method(results, kHybridEarlyOut, group).time) << " | "
      << text("%.1f", of_method(results, kCcdMpr, group).time / hybrid.time) << " | "
      << text("%.1f", time_per_evaluation(results, kFloorCost, group) * 1e9) << " | "
      << text("%.1f", time_per_evaluation(results, kPointCost, group) * 1e9) << " | " << text("%.1f", evaluation * 1e9) << " | "
      << text("%.2f", hybrid.time / (hybrid.evaluations * evaluation)) << " |\n";
}

void write_ratios(const Results& results, std::ostream& out) {
  out << "| class and pose | EPA / hybrid | EPA / warm | EPA / early out | MPR / hybrid | floor: ns | h, r: ns | h, r, H: ns | "
         "hybrid / its "
         "evaluations |\n"
         "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const BodyClass body_class : kBodyClasses) {
    for (const Situation situation : kSituations) {
      write_ratio_row(results, {letter(body_class), ' ', letter(situation)}, group_of(body_class, situation), out);
    }
  }
  const auto overlaps = [](const Pair& pair) { return pair.situation == Situation::Shallow || pair.situation == Situation::Deep; };
  write_ratio_row(
      results, "E, S and D", [=](const Pair& p) { return overlaps(p) && p.body_class == BodyClass::Ellipsoid; }, out);
  write_ratio_row(
      results, "M and B, S and D", [=](const Pair& p) { return overlaps(p) && p.body_class != BodyClass::Ellipsoid; }, out);
}

}  // namespace

void write_markdown(const Results& results, std::ostream& out) {
  for (const auto& [name, value] : environment()) out << "* " << name << ": " << value << "\n";
  out << "* pairs: " << results.pairs.size()
      << "\n\nClasses: E ellipsoids, M exponents 1.3…5, B exponents 6…20. Poses: S 1 % overlap, D 30 % overlap, N 1 % apart, F "
         "far.\n"
         "Medians over the pairs; errors of the gap, relative to the smallest half-axis; an evaluation is one of both bodies.\n\n";
  write_methods(results, out);
  out << "\nRatios of median times, the time of one evaluation of both bodies beside its floor, eight logarithms\n"
         "and exponentials of the C library (superellipsoids; ellipsoids have none), and the hybrid's time over that of its "
         "evaluations.\n\n";
  write_ratios(results, out);
}

void write_csv(const Results& results, const std::string& path) {
  std::ofstream file(path);
  for (const auto& [name, value] : environment()) file << "# " << name << ": " << value << "\n";
  file << "class,pose,method,queries,time_s,evaluations,median_error,worst_error,inexact,failures\n";
  for (const BodyClass body_class : kBodyClasses) {
    for (const Situation situation : kSituations) {
      for (std::size_t m = 0; m < results.methods.size(); ++m) {
        const Statistics s = statistics(results.samples[m], results.pairs, group_of(body_class, situation));
        file << letter(body_class) << ',' << letter(situation) << ",\"" << results.methods[m]->name() << "\"," << s.queries << ','
             << number(s.time) << ',' << number(s.evaluations) << ',' << number(s.median_error) << ',' << number(s.worst_error)
             << ',' << s.inexact << ',' << s.failures() << '\n';
      }
    }
  }
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace accuracy_cost
