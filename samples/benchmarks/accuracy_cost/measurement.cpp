#include "measurement.hpp"

#include <algorithm>
#include <chrono>
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

}  // namespace accuracy_cost
