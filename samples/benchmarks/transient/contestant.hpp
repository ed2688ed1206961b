// The compared methods, as narrow phases of a world.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "methods/method.hpp"

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

}  // namespace transient
