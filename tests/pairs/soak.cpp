// Samples of the soak on all threads. One sample alone is printed in full.
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "pairs/kinds.hpp"
#include "soak/examination.hpp"
#include "soak/sample.hpp"

namespace supernormal::soak {
namespace {

using samples::exact_text;
using test::Draws;
using test::Report;

constexpr std::size_t kMostListed = 20;

/// The largest figure of any sample, and the first sample that has it.
struct Largest {
  double value = -1;
  std::uint64_t sample = 0;

  void add(const Largest& other) {
    if (other.value > value || (other.value == value && other.sample < sample)) *this = other;
  }
};

struct Tally {
  std::uint64_t queries = 0, evaluations = 0;
  std::uint64_t not_global = 0,
                not_converged = 0;  ///< samples with an answer that does not claim to be global, or to have converged
  Largest error, error_of_bound, most_evaluations;
  std::vector<std::uint64_t> violated;

  void add(std::uint64_t sample, const Finding& finding) {
    queries += finding.queries;
    evaluations += finding.evaluations;
    not_global += finding.is_global ? 0 : 1;
    not_converged += finding.is_converged ? 0 : 1;
    error.add({finding.error, sample});
    error_of_bound.add({finding.error_of_bound, sample});
    most_evaluations.add({static_cast<double>(finding.most_evaluations), sample});
    if (!finding.violations.empty()) violated.push_back(sample);
  }
};

/// The tally is the same for any number of threads.
Tally examine_all(const SampleSource& source, Care care, const Draws& draws) {
  std::atomic<std::uint64_t> next{draws.first};
  std::mutex mutex;
  Tally tally;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      Sample sample;
      for (std::uint64_t index = next++; index < draws.first + draws.count; index = next++) {
        source.draw(index, sample);
        const Finding finding = examine(sample, source.random_of_checks(index), care);
        const std::scoped_lock lock(mutex);
        tally.add(index, finding);
      }
    } catch (...) {
      const std::scoped_lock lock(mutex);
      failure = std::current_exception();
    }
  };
  std::vector<std::thread> team;
  for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k) team.emplace_back(work);
  work();
  for (std::thread& thread : team) thread.join();
  if (failure) std::rethrow_exception(failure);
  std::ranges::sort(tally.violated);
  return tally;
}

void print(const char* name, const samples::Body& body, const Pose& pose) {
  std::printf("%s: %s\n  lengths %s, exponents %s %s, taper %s %s, rounding %s\n", name, samples::describe(body).c_str(),
              exact_text(body.lengths).c_str(), exact_text(body.delta).c_str(), exact_text(body.epsilon).c_str(),
              exact_text(body.taper_x).c_str(), exact_text(body.taper_y).c_str(), exact_text(body.rounding).c_str());
  for (const Vector3& point : body.points) std::printf("  point %s\n", exact_text(point).c_str());
  std::printf("  position %s\n", exact_text(pose.position).c_str());
  for (int row = 0; row < 3; ++row) std::printf("  rotation %s\n", exact_text(Vector3(pose.rotation.row(row))).c_str());
}

void print(const Sample& sample) {
  std::printf("%s\n", sample.pair.name.c_str());
  print("body 1", sample.pair.body1, sample.pair.pose1);
  print("body 2", sample.pair.body2, sample.pair.pose2);
  if (sample.pair.first_normal) std::printf("first normal %s\n", exact_text(*sample.pair.first_normal).c_str());
  if (sample.placed_gap) std::printf("placed gap %s\n", exact_text(*sample.placed_gap).c_str());
  std::printf("tolerance %g\n", sample.settings.tolerance);
  samples::Violations ignored;
  const Proximity answer = samples::solve(sample.pair, sample.settings, ignored);
  std::printf("answer: gap %s, error %s, normal %s\n  point1 %s, point2 %s\n  %d evaluations, status %d, %s, global error %s\n",
              exact_text(answer.gap).c_str(), exact_text(answer.error).c_str(), exact_text(answer.normal).c_str(),
              exact_text(answer.point1).c_str(), exact_text(answer.point2).c_str(), answer.evaluations,
              static_cast<int>(answer.status), answer.is_global ? "global" : "not sure to be global",
              exact_text(answer.global_error).c_str());
}

void run(const Draws& draws, Mix mix, Report& report) {
  const Care care = mix == Mix::Sharp ? Care::Neighbourhood : Care::Usual;
  const SampleSource source(draws.seed, mix);
  Sample sample;
  if (draws.count == 1) {
    source.draw(draws.first, sample);
    print(sample);
  }
  const Tally tally = examine_all(source, care, draws);
  const auto share = [&](std::uint64_t count) { return 100 * static_cast<double>(count) / static_cast<double>(draws.count); };
  report.head({"samples", "number"});
  report.row("queries", {static_cast<double>(tally.queries)});
  report.row("evaluations of a query", {static_cast<double>(tally.evaluations) / static_cast<double>(tally.queries)});
  report.row("% with an answer that does not claim to be global", {share(tally.not_global)});
  report.row("% with an answer that has not converged", {share(tally.not_converged)});
  report.head({"largest", "of a sample", "FIRST"});
  const auto row = [&](const char* what, const Largest& largest) {
    report.row(what, {largest.value, static_cast<double>(largest.sample)});
  };
  row("error, in units of the smaller body's largest half-extent", tally.error);
  row("error, in units of the promised bound and rounding", tally.error_of_bound);
  row("evaluations of a query", tally.most_evaluations);
  for (std::size_t k = 0; k < tally.violated.size(); ++k) {
    std::string what = "FIRST " + std::to_string(tally.violated[k]);
    if (k < kMostListed) {
      source.draw(tally.violated[k], sample);
      for (const std::string& violation : examine(sample, source.random_of_checks(tally.violated[k]), care).violations)
        what += "; " + violation;
    }
    report.fault(what);
  }
}

}  // namespace
}  // namespace supernormal::soak

void supernormal::test::run_soak(const Draws& draws, Report& report) { soak::run(draws, soak::Mix::Everything, report); }
void supernormal::test::run_sharp_soak(const Draws& draws, Report& report) { soak::run(draws, soak::Mix::Sharp, report); }
