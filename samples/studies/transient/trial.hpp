// One method in one world: what it costs, where it fails, and what that does to the motion.
#pragma once

#include <limits>
#include <vector>

#include "contestant.hpp"
#include "throw.hpp"

namespace transient {

/// The positions of all bodies after each step.
using Path = std::vector<std::vector<Vector3>>;

struct Outcome {
  unsigned long long queries = 0, warm_queries = 0;
  unsigned long long failed = 0;     ///< queries without an answer, of all
  double evaluations = 0;            ///< of both bodies; 0 where the method counts none
  double seconds = 0;                ///< of the processor, in queries
  unsigned long long judged = 0;     ///< queries that were compared with the certified answer for the same poses
  unsigned long long wrong = 0;      ///< overlaps whose depth is wrong by more than 1e-6 of the smallest half-axis
  unsigned long long missed = 0;     ///< overlaps that the method calls apart
  unsigned long long invented = 0;   ///< contacts of bodies apart
  unsigned long long undecided = 0;  ///< the certified search ran out of evaluations
  double energy_drift = 0;           ///< largest change of the kinetic energy, of that at the start; elastic bodies alone
  double momentum_drift = 0;         ///< largest change by a step without walls, of the sum of all at the start; likewise
  /// s; when a body is first farther than 1 % of its smallest half-axis from where it is in the certified world; infinite: never
  double parted = std::numeric_limits<double>::infinity();
  /// After each step: the largest distance of a body from its place in the certified world, in its smallest half-axes.
  std::vector<double> distances{};
};

struct Trial {
  Setup setup;
  double duration = 1;     ///< s
  int judged_steps = 100;  ///< at most, evenly spread
};

/// Runs the contestant. `path` receives the positions, if it is given. `certified` is the path of the certified world, or null.
Outcome run(const Trial& trial, const Contestant& contestant, bool is_disturbed, const Path* certified, Path* path);

/// Asks the contestant in every step of the certified world, which moves by the certified answers: what it costs and where it fails
/// for the same poses as all others. Every answer is judged; of the motion nothing is told.
Outcome watch(const Trial& trial, const Contestant& contestant);

}  // namespace transient
