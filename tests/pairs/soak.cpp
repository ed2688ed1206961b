// Samples of the soak on all threads, alone and among many. One sample alone is printed in full.
#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "pairs/kinds.hpp"
#include "proximity/among_many.hpp"
#include "soak/examination.hpp"
#include "soak/sample.hpp"
#include "support/counted_allocations.hpp"
#include "support/painted_stack.hpp"
#include "support/traps.hpp"

namespace supernormal::soak {
namespace {

using samples::exact_text;
using test::Draws;
using test::Report;

constexpr std::size_t kMostListed = 20;
constexpr std::uint64_t kBatch = 251;  // a prime number, so that no width fills its lanes evenly

/// Calls work(index) for all samples, on all threads.
void for_each_sample(const Draws& draws, const std::function<void(std::uint64_t)>& work) {
  std::atomic<std::uint64_t> next{draws.first};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto go = [&] {
    try {
      for (std::uint64_t index = next++; index < draws.first + draws.count; index = next++) work(index);
    } catch (...) {
      const std::scoped_lock lock(mutex);
      failure = std::current_exception();
    }
  };
  std::vector<std::thread> team;
  for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k) team.emplace_back(go);
  go();
  for (std::thread& thread : team) thread.join();
  if (failure) std::rethrow_exception(failure);
}

/// Samples together, with the settings of the first: in every way they have the digits of each alone, under floating-point traps,
/// and no way allocates.
void ask_among_many(const SampleSource& source, std::uint64_t first, std::uint64_t count, Report& report) {
  std::vector<Sample> samples(count);
  std::vector<ProximityQuery> queries;
  for (std::uint64_t k = 0; k < count; ++k) {
    source.draw(first + k, samples[k]);
    const samples::HardCase& one = samples[k].pair;
    const Vector3* const normal = one.first_normal ? &*one.first_normal : nullptr;
    queries.push_back({one.shape1.get(), &one.pose1, one.shape2.get(), &one.pose2, normal});
  }
  const Settings settings = samples[0].settings;
  std::vector<Proximity> alone(count), among(count);
  for (std::uint64_t k = 0; k < count; ++k) alone[k] = find_proximity(queries[k], settings);
  for (const test::WayAmongMany& way : test::ways_among_many()) {
    const long before = test::allocations();
    {
      const test::Traps traps(way.name.c_str());
      way.ask(queries, settings, among);
    }
    if (test::allocations() != before) report.fault(way.name + " allocates, from FIRST " + std::to_string(first));
    for (std::uint64_t k = 0; k < count; ++k) {
      if (test::are_identical(test::numbers_of(alone[k]), test::numbers_of(among[k]))) continue;
      report.fault("FIRST " + std::to_string(first + k) + ": other digits by " + way.name + ", tolerance " +
                   exact_text(settings.tolerance));
    }
  }
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
  std::mutex mutex;
  std::uint64_t evaluations = 0, not_global = 0, not_converged = 0;
  std::map<std::uint64_t, samples::Violations> violated;
  for_each_sample(draws, [&](std::uint64_t index) {
    thread_local Sample one;
    source.draw(index, one);
    const Finding finding = examine(one, source.random_of_checks(index), care);
    const std::scoped_lock lock(mutex);
    evaluations += static_cast<std::uint64_t>(finding.answer.evaluations);
    not_global += finding.answer.is_global ? 0 : 1;
    not_converged += finding.answer.status == Status::Converged ? 0 : 1;
    if (!finding.violations.empty()) violated[index] = finding.violations;
  });
  const auto share = [&](std::uint64_t count) { return static_cast<double>(count) / static_cast<double>(draws.count); };
  report.head({"samples", "number"});
  report.row("evaluations of a cold query", {share(evaluations)});
  report.row("% that do not claim to be global", {100 * share(not_global)});
  report.row("% that have not converged", {100 * share(not_converged)});
  std::size_t listed = 0;
  for (const auto& [index, violations] : violated) {
    std::string what = "FIRST " + std::to_string(index);
    if (listed++ < kMostListed) {
      for (const std::string& violation : violations) what += "; " + violation;
    }
    report.fault(what);
  }
}

}  // namespace
}  // namespace supernormal::soak

void supernormal::test::run_soak(const Draws& draws, Report& report) { soak::run(draws, soak::Mix::Everything, report); }
void supernormal::test::run_sharp_soak(const Draws& draws, Report& report) { soak::run(draws, soak::Mix::Sharp, report); }

void supernormal::test::run_lanes(const Draws& draws, Report& report) {
  const soak::SampleSource source(draws.seed);
  report.head({"samples among many", "number"});
  for (std::uint64_t first = 0; first < draws.count; first += soak::kBatch) {
    soak::ask_among_many(source, first, std::min(soak::kBatch, draws.count - first), report);
  }
  report.row("in each way", {static_cast<double>(draws.count)});
}
