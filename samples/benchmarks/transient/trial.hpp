// The compared methods as narrow phases of a world, and one of them in one world: its cost, its failures, and their effect on the
// motion.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "methods/method.hpp"
#include "throw.hpp"

namespace transient {

struct Contestant {
  std::string name;
  std::string start;  ///< "cold", or "warm": from the answer of the step before
  std::unique_ptr<accuracy_cost::Method> cold;
  std::unique_ptr<accuracy_cost::Method> warm;  ///< null: every query is cold
};

inline constexpr const char* kCertified = "certified";

/// The certified proximity: the hybrid at tolerance 1e-12, which proves the depth minimal.
supernormal::Proximity certified_proximity(const accuracy_cost::Pair& pair);

/// The certified answer first.
std::vector<Contestant> contestants();

/// The positions of all bodies after each step.
using Path = std::vector<std::vector<Vector3>>;

struct Outcome {
  unsigned long long queries = 0;
  unsigned long long failed = 0;  ///< queries without an answer
  double evaluations = 0;         ///< of both bodies; 0 if the method does not count them
  double seconds = 0;             ///< s; processor time of the queries
  // In the certified world alone, where every answer is compared:
  unsigned long long wrong = 0;      ///< overlaps whose depth is wrong by more than 1e-6 of the smallest half-axis
  unsigned long long missed = 0;     ///< overlaps that the method reports as apart
  unsigned long long invented = 0;   ///< contacts of bodies that are apart
  unsigned long long undecided = 0;  ///< the certified search ran out of evaluations
  /// s; when a body is first farther than 1 % of its smallest half-axis from its position in the certified world; infinite: never
  double parted = std::numeric_limits<double>::infinity();
  /// After each step: the largest distance of a body from its position in the certified world, in its smallest half-axes.
  std::vector<double> distances{};
};

struct Trial {
  Setup setup;
  double duration = 1;  ///< s
};

/// Runs the contestant. `path` receives the positions, if given. `certified` is the path of the certified world, or null.
Outcome run(const Trial& trial, const Contestant& contestant, bool is_disturbed, const Path* certified, Path* path);

/// Queries the contestant in every step of the certified world, which moves by the certified answers. This measures cost and
/// failures for the same poses as for all others. Every answer is compared. No motion is reported.
Outcome watch(const Trial& trial, const Contestant& contestant);

}  // namespace transient
