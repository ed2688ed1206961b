// Statistics of a method's samples on a group of pairs.
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
  double median_error = 0;  ///< error of the gap, relative to the smallest half-axis; NaN if the method told no gap
  double large_error = 0;   ///< 99th percentile
  double worst_error = 0;
  double normal_error = 0;    ///< rad; median of the angle between the normals
  double contact_error = 0;   ///< median distance of the contact points, relative to the smallest half-axis; NaN if none was told
  std::size_t inexact = 0;    ///< gaps off by more than 1e-6 of the smallest half-axis
  std::size_t no_answer = 0;  ///< the method gave up
  std::size_t wrong_verdict = 0;  ///< bodies apart were said to overlap, or the other way; if they touch, any verdict is right
  std::size_t wrong_gap = 0;      ///< wrong by more than 10 % of the gap + 0.001 of the smallest half-axis

  std::size_t failures() const { return no_answer + wrong_verdict + wrong_gap; }
};

/// The value that a `share` of them are below; NaN if there are none.
double quantile(std::vector<double> values, double share);
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// The statistics of one method on the pairs that are chosen.
Statistics statistics(const std::vector<Sample>& samples, const std::vector<Pair>& pairs,
                      const std::function<bool(const Pair&)>& is_chosen);

}  // namespace accuracy_cost
