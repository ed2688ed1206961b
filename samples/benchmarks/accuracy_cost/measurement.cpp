#include "measurement.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>

namespace accuracy_cost {

namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

/// The time between two consecutive readings of the clock, which is subtracted.
double clock_cost() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 10000; ++i) {
    const auto start = Clock::now();
    least = std::min(least, seconds(Clock::now() - start));
  }
  return least;
}

/// A sink for results, so that the compiler keeps the queries.
volatile double sink;

double time_queries(const Method& method, const Pair& pair, int repeats) {
  const auto start = Clock::now();
  for (int i = 0; i < repeats; ++i) sink = method.query(pair).gap;
  return seconds(Clock::now() - start);
}

// A thousand times the default tolerance. A larger error belongs to another maximum, or to another kind of method.
constexpr double kInexact = 1e-6;

constexpr double kLarge = 0.99;  // quantile for "large"

void count_failure(const Answer& answer, const Pair& pair, Statistics& result) {
  const bool is_apart = pair.gap > 0;
  const bool is_touching = std::abs(pair.gap) <= kInexact * pair.size;
  const bool says_apart = answer.kind == Answer::Kind::Apart || answer.gap > 0;
  const bool is_near = std::abs(answer.gap - pair.gap) <= 0.1 * std::abs(pair.gap) + 0.001 * pair.size;
  if (answer.kind == Answer::Kind::None) {
    ++result.no_answer;
  } else if (says_apart != is_apart && !is_touching) {
    ++result.wrong_verdict;
  } else if (answer.kind == Answer::Kind::Gap && !is_near) {
    ++result.wrong_gap;
  }
}

}  // namespace

std::vector<std::vector<Sample>> measure(const Methods& methods, const std::vector<Pair>& pairs, const Effort& effort) {
  const double overhead = clock_cost();
  std::vector<std::vector<Sample>> samples(methods.size(), std::vector<Sample>(pairs.size()));
  std::vector<std::vector<int>> repeats(methods.size(), std::vector<int>(pairs.size(), 1));
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    for (std::size_t m = 0; m < methods.size(); ++m) {
      samples[m][p] = {methods[m]->query(pairs[p]), std::numeric_limits<double>::infinity()};
      const double once = std::max(time_queries(*methods[m], pairs[p], 1) - overhead, 1e-9);
      repeats[m][p] = std::max(1, static_cast<int>(std::min(effort.batch / once, 1e4)));
    }
  }
  for (int round = 0; round < effort.rounds; ++round) {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      for (std::size_t turn = 0; turn < methods.size(); ++turn) {
        const std::size_t m = (turn + static_cast<std::size_t>(round)) % methods.size();  // every method has varying predecessors
        const double time = (time_queries(*methods[m], pairs[p], repeats[m][p]) - overhead) / repeats[m][p];
        samples[m][p].time = std::min(samples[m][p].time, time);
      }
    }
  }
  return samples;
}

void improve_references(const std::vector<std::vector<Sample>>& samples, std::vector<Pair>& pairs) {
  for (const auto& of_method : samples) {
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      if (of_method[p].answer.kind == Answer::Kind::Gap) improve_reference(pairs[p], of_method[p].answer.normal);
    }
  }
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto place = values.begin() + std::min(rank, std::ssize(values) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Statistics statistics(const std::vector<Sample>& samples, const std::vector<Pair>& pairs) {
  Statistics result;
  std::vector<double> times, evaluations, errors, normal_errors, contact_errors;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const Sample& sample = samples[p];
    times.push_back(sample.time);
    evaluations.push_back(sample.answer.evaluations);
    if (sample.answer.kind == Answer::Kind::Gap) {
      errors.push_back(std::abs(sample.answer.gap - pairs[p].gap) / pairs[p].size);
      normal_errors.push_back(2 * std::asin(std::min(1.0, 0.5 * (sample.answer.normal - pairs[p].normal).norm())));
    }
    if (sample.answer.contact) contact_errors.push_back((*sample.answer.contact - pairs[p].contact).norm() / pairs[p].size);
    count_failure(sample.answer, pairs[p], result);
  }
  result.inexact = static_cast<std::size_t>(std::count_if(errors.begin(), errors.end(), [](double e) { return !(e <= kInexact); }));
  result.queries = times.size();
  result.worst_error = errors.empty() ? median(errors) : *std::max_element(errors.begin(), errors.end());
  result.slow_time = quantile(times, kLarge);
  result.large_error = quantile(errors, kLarge);
  result.normal_error = median(std::move(normal_errors));
  result.contact_error = median(std::move(contact_errors));
  result.time = median(std::move(times));
  result.evaluations = median(std::move(evaluations));
  result.median_error = median(std::move(errors));
  return result;
}

common::Environment environment() {
  common::Environment lines = common::environment();
  lines.emplace_back("ODE", dODE_VERSION);
  lines.emplace_back("libccd (by its ccd.pc)", ACCURACY_COST_CCD_VERSION);
#ifdef ACCURACY_COST_BULLET_VERSION
  lines.emplace_back("Bullet", ACCURACY_COST_BULLET_VERSION);
#else
  lines.emplace_back("Bullet", "missing at the build: not measured");
#endif
  return lines;
}

}  // namespace accuracy_cost
