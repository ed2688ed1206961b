// Times of impact by a host and by us, on the same pairs in the same run.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "moving_pairs.hpp"

namespace supernormal::impact_hosts {

/// What a search returns that finds no impact until the horizon, s.
inline constexpr double kNoImpact = 2 * kHorizon;

/// A way to find times of impact.
struct Contestant {
  std::string name;
  /// Makes the host's bodies of a pair, and returns the search, which alone is timed: the time of the impact in s, or kNoImpact.
  std::function<std::function<double()>(const MovingPair&)> prepare;
  bool follows_turns = true;  ///< whether bodies that turn may be given to it
};

/// Compares the host's contestants with ours on 1000 pairs of every kind, and prints a line for each. The truth is our search with
/// a tolerance of 1e-12; the error of a time is the gap that the bodies have then. Processor time, the least of five runs, in turn.
///
/// Returns whether ours, to 1e-9, has found every impact and nothing else, and each contestant of the host more than half of the
/// impacts of bodies that go straight: one that finds fewer has been given other bodies.
bool compare(std::span<const Bodies> kinds, const std::vector<Contestant>& host);

}  // namespace supernormal::impact_hosts
