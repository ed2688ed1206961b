// Runs every method on every pair, measures the time, and sums up what is found.
#pragma once

#include <vector>

#include "methods/method.hpp"

namespace accuracy_cost {

struct Effort {
  int rounds = 7;  ///< passes over all pairs; the shortest time of each pair and method is used
  double batch =
      10e-6;  ///< s; duration of the repetitions per timing. 0: a single query, with caches and predictors as left by other queries
};

struct Sample {
  Answer answer;
  double time = 0;  ///< s per query
};

/// Returns samples[method][pair]. The methods take turns on each pair, so that a disturbance of the machine affects all of them.
std::vector<std::vector<Sample>> measure(const Methods& methods, const std::vector<Pair>& pairs, const Effort& effort);

/// Raises the reference of each pair for which a method found a higher maximum.
void improve_references(const std::vector<std::vector<Sample>>& samples, std::vector<Pair>& pairs);

struct Statistics {
  std::size_t queries = 0;
  double time = 0;          ///< s; median over the pairs
  double slow_time = 0;     ///< s; 99th percentile
  double evaluations = 0;   ///< median
  double median_error = 0;  ///< error of the gap, relative to the smallest half-axis; NaN without gaps
  double large_error = 0;   ///< 99th percentile
  double worst_error = 0;
  double normal_error = 0;    ///< rad; median of the angle between the normals
  double contact_error = 0;   ///< median distance of the contact points, relative to the smallest half-axis; NaN without contacts
  std::size_t inexact = 0;    ///< gaps off by more than 1e-6 of the smallest half-axis
  std::size_t no_answer = 0;  ///< the method gave up
  std::size_t wrong_verdict = 0;  ///< separate bodies reported as overlapping or vice versa; touching bodies are never wrong
  std::size_t wrong_gap = 0;      ///< error above 10 % of the gap + 0.001 of the smallest half-axis

  std::size_t failures() const { return no_answer + wrong_verdict + wrong_gap; }
};

/// The quantile of the values at the fraction `share`. NaN if there are none.
double quantile(std::vector<double> values, double share);
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// The statistics of one method over the pairs.
Statistics statistics(const std::vector<Sample>& samples, const std::vector<Pair>& pairs);

/// That of the build, and the versions of the measured libraries.
common::Environment environment();

}  // namespace accuracy_cost
