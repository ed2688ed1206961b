// The soak program: draws samples, queries and checks them, up to a number of queries.
//
//     soak --queries 1e9 --seed 1 --resume soak.txt     in pieces: Ctrl-C, and the same command again
//     soak --seed 1 --only 4711                         one sample, in full
//     soak --queries 1e8 --seed 1 --sharp               searches longer where most faults have been found
//
// Exit code 0: no violation; 1: some, each with the command that repeats it; 2: a mistake in the command; 130: interrupted.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cfenv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>
#include <vector>

#include "examination.hpp"
#include "sample.hpp"
#include "tally.hpp"

namespace supernormal::soak {
namespace {

using Clock = std::chrono::steady_clock;
using samples::exact_text;

constexpr std::uint64_t kBlock = 64;            // samples that a thread takes at a time
constexpr std::uint64_t kMostPerRound = 16384;  // samples between two looks at the clock
constexpr double kQueriesPerSample = 4;
constexpr double kReportInterval = 10;  // s

std::atomic<bool> is_interrupted{false};

struct Options {
  double queries = 1e6;
  std::uint64_t seed = 1;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  std::string state_file;
  std::int64_t only = -1;
  bool trap = false;
  bool sharp = false;

  Care care() const { return sharp ? Care::Neighbourhood : Care::Usual; }
};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

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
}

void print(const Proximity& answer) {
  std::printf("answer: gap %s, error %s, normal %s\n  point1 %s, point2 %s\n  %d evaluations, status %d, %s, global error %s\n",
              exact_text(answer.gap).c_str(), exact_text(answer.error).c_str(), exact_text(answer.normal).c_str(),
              exact_text(answer.point1).c_str(), exact_text(answer.point2).c_str(), answer.evaluations,
              static_cast<int>(answer.status), answer.is_global ? "global" : "not sure to be global",
              exact_text(answer.global_error).c_str());
}

/// Examines one sample in full. With `trap`, for a debugger, an exception ends the program at its origin.
int examine_only(const SampleSource& source, const Options& options) {
  const auto index = static_cast<std::uint64_t>(options.only);
  Sample sample;
  source.draw(index, sample);
  print(sample);
#ifdef __GLIBC__
  if (options.trap) feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
#endif
  samples::Violations ignored;
  print(samples::solve(sample.pair, sample.settings, ignored));
  const Finding finding = examine(sample, source.random_of_checks(index), options.care());
  for (const std::string& violation : finding.violations) std::printf("VIOLATED: %s\n", violation.c_str());
  return finding.violations.empty() ? 0 : 1;
}

/// Examines the samples first ... end - 1 on all threads.
Tally run_round(const SampleSource& source, const Options& options, std::uint64_t first, std::uint64_t end) {
  std::atomic<std::uint64_t> next{first};
  std::vector<Tally> tallies(options.threads);
  std::vector<std::exception_ptr> failures(options.threads);
  const auto work = [&](unsigned k) {
    try {
      Sample sample;
      for (std::uint64_t from = next.fetch_add(kBlock); from < end; from = next.fetch_add(kBlock)) {
        for (std::uint64_t index = from; index < std::min(from + kBlock, end); ++index) {
          source.draw(index, sample);
          tallies[k].add(index, examine(sample, source.random_of_checks(index), options.care()));
        }
      }
    } catch (...) {
      failures[k] = std::current_exception();
    }
  };
  std::vector<std::thread> team;
  for (unsigned k = 1; k < options.threads; ++k) team.emplace_back(work, k);
  work(0);
  for (std::thread& thread : team) thread.join();
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  Tally all;
  for (const Tally& tally : tallies) all.add(tally);
  return all;
}

void print_progress(const Tally& tally, double queries) {
  std::printf("%5.1f %%  %.3g queries in %.0f s, %.3g per second, %llu samples with violations\n",
              std::min(100.0, 100 * static_cast<double>(tally.queries) / queries), static_cast<double>(tally.queries),
              tally.seconds, static_cast<double>(tally.queries) / tally.seconds, static_cast<unsigned long long>(tally.violations));
  std::fflush(stdout);
}

void print_ranking(const char* title, const Ranking& ranking, const SampleSource& source) {
  std::printf("%s:\n", title);
  Sample sample;
  for (const auto& [value, index] : ranking.entries()) {
    source.draw(index, sample);
    std::printf("  %-12.4g --only %-12llu %s\n", value, static_cast<unsigned long long>(index), sample.pair.name.c_str());
  }
}

void print_violations(const Tally& tally, const SampleSource& source, const Options& options) {
  Sample sample;
  for (const std::uint64_t index : tally.violated) {
    source.draw(index, sample);
    const Finding finding = examine(sample, source.random_of_checks(index), options.care());
    std::printf("VIOLATED: %s: %s\n  soak --seed %llu --only %llu%s\n", sample.pair.name.c_str(),
                finding.violations.empty() ? "not again" : finding.violations.front().c_str(),
                static_cast<unsigned long long>(options.seed), static_cast<unsigned long long>(index),
                options.sharp ? " --sharp" : "");
  }
}

void print_summary(const Tally& tally, const SampleSource& source) {
  const auto share = [&](std::uint64_t count) { return 100 * static_cast<double>(count) / static_cast<double>(tally.samples); };
  std::printf("%llu queries of %llu samples, %.1f evaluations each; %.3g s, %.3g queries per second\n",
              static_cast<unsigned long long>(tally.queries), static_cast<unsigned long long>(tally.samples),
              static_cast<double>(tally.evaluations) / static_cast<double>(tally.queries), tally.seconds,
              static_cast<double>(tally.queries) / tally.seconds);
  std::printf("samples with an answer that does not claim to be global: %.3g %%; that has not converged: %.3g %%\n",
              share(tally.not_global), share(tally.not_converged));
  print_ranking("largest errors, in units of the smaller body's largest half-extent", tally.by_error, source);
  print_ranking("largest errors, in units of the promised bound and rounding", tally.by_error_of_bound, source);
  print_ranking("most evaluations in a query", tally.by_evaluations, source);
}

int run(const SampleSource& source, const Options& options) {
  const bool is_kept = !options.state_file.empty();
  Tally tally = is_kept ? load(options.seed, options.state_file) : Tally();
  const double seconds_before = tally.seconds;
  const Clock::time_point start = Clock::now();
  double last_report = 0;
  while (static_cast<double>(tally.queries) < options.queries && !is_interrupted) {
    const double missing = (options.queries - static_cast<double>(tally.queries)) / kQueriesPerSample;
    const auto size = std::min(kMostPerRound, static_cast<std::uint64_t>(std::ceil(missing)));
    tally.add(run_round(source, options, tally.samples, tally.samples + size));
    const double elapsed = seconds_since(start);
    tally.seconds = seconds_before + elapsed;
    if (elapsed - last_report < kReportInterval) continue;
    last_report = elapsed;
    print_progress(tally, options.queries);
    if (is_kept) save(tally, options.seed, options.state_file);
  }
  if (is_kept) save(tally, options.seed, options.state_file);
  print_summary(tally, source);
  print_violations(tally, source, options);
  if (tally.violations > 0) {
    std::printf("%llu samples with violations\n", static_cast<unsigned long long>(tally.violations));
    return 1;
  }
  if (is_interrupted) return 130;
  std::printf("no violation\n");
  return 0;
}

int run_program(int argc, char** argv) {
  CLI::App app("Asks for the proximity of pairs of bodies, hard ones among them, and checks every answer.");
  Options options;
  app.add_option("--queries", options.queries, "calls of find_proximity, those of earlier pieces included")
      ->check(CLI::Range(1.0, 1e15))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "another seed: other samples")->capture_default_str();
  app.add_option("--threads", options.threads)->check(CLI::Range(1U, 1024U))->capture_default_str();
  CLI::Option* const resume =
      app.add_option("--resume", options.state_file, "continues what this file keeps, and keeps it up to date");
  app.add_option("--only", options.only, "this sample alone, in full")->check(CLI::NonNegativeNumber);
  app.add_flag("--trap", options.trap, "with --only: floating-point exceptions end the program, for a debugger");
  app.add_flag("--sharp", options.sharp,
               "random pairs of any exponents only, sharp beside flat, each answer's neighbourhood searched")
      ->excludes(resume);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  std::signal(SIGINT, [](int) { is_interrupted = true; });
  std::signal(SIGTERM, [](int) { is_interrupted = true; });
  const SampleSource source(options.seed, options.sharp ? Mix::Sharp : Mix::Everything);
  return options.only >= 0 ? examine_only(source, options) : run(source, options);
}

}  // namespace
}  // namespace supernormal::soak

int main(int argc, char** argv) {
  try {
    return supernormal::soak::run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "soak: %s\n", error.what());
    return 2;
  }
}
