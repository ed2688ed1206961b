// Runs every method on every pair and measures the time.
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

}  // namespace accuracy_cost
