// Runs every method on every pair and takes the time.
#pragma once

#include <vector>

#include "methods/method.hpp"

namespace accuracy_cost {

struct Effort {
  int rounds = 7;        ///< passes over all pairs; the shortest time of each pair and method counts
  double batch = 10e-6;  ///< s; a query is repeated for about this long per timing. 0: once, with what other queries left in
                         ///< caches and branch predictors
};

struct Sample {
  Answer answer;
  double time = 0;  ///< s per query
};

/// Returns samples[method][pair]. All methods take turns on each pair, so that whatever slows the machine down slows all of them.
std::vector<std::vector<Sample>> measure(const Methods& methods, const std::vector<Pair>& pairs, const Effort& effort);

/// Raises the references of those pairs for which a method found a higher maximum.
void improve_references(const std::vector<std::vector<Sample>>& samples, std::vector<Pair>& pairs);

}  // namespace accuracy_cost
