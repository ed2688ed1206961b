// Statistics of a method over a group of pairs.
#pragma once

#include <functional>
#include <vector>

#include "measurement.hpp"

namespace accuracy_cost {

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

/// The statistics of one method over the chosen pairs.
Statistics statistics(const std::vector<Sample>& samples, const std::vector<Pair>& pairs,
                      const std::function<bool(const Pair&)>& is_chosen);

}  // namespace accuracy_cost
