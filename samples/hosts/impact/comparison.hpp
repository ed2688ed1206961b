// Times of impact by a host and by this library, on the same pairs in the same run.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "moving_pairs.hpp"

namespace supernormal::impact_hosts {

/// The result of a search that finds no impact until the horizon, s.
inline constexpr double kNoImpact = 2 * kHorizon;

/// A method that finds times of impact.
struct Contestant {
  std::string name;
  /// Makes the host's bodies of a pair, and returns the search. Only the search is timed. It returns the time of the impact in s,
  /// or kNoImpact.
  std::function<std::function<double()>(const MovingPair&)> prepare;
  bool follows_turns = true;  ///< whether the bodies may rotate
};

/// Compares the host's contestants with ours on 1000 pairs of every kind, and prints a line for each. The truth is our search with
/// a tolerance of 1e-12. The error of a time is the gap of the bodies at that time. Times are processor times, the smallest of five
/// alternating runs.
///
/// Returns true if two conditions hold. Ours, to 1e-9, has found every impact and nothing else. Each contestant of the host has
/// found more than half of the impacts of bodies that do not rotate; a contestant that finds fewer got other bodies.
bool compare(std::span<const Bodies> kinds, const std::vector<Contestant>& host);

}  // namespace supernormal::impact_hosts
