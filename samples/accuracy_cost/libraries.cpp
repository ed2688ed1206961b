#include <array>
#include <cstdio>

#include "method.hpp"

namespace accuracy_cost {

// CMakeLists.txt defines the version of what it found, and compiles that library's methods.

#ifndef ACCURACY_COST_BULLET_VERSION
#define ACCURACY_COST_BULLET_VERSION ""
Methods bullet_methods() { return {}; }
#endif

#ifndef ACCURACY_COST_FCL_VERSION
#define ACCURACY_COST_FCL_VERSION ""
Methods fcl_methods() { return {}; }
#endif

#ifndef ACCURACY_COST_SIMBODY_VERSION
#define ACCURACY_COST_SIMBODY_VERSION ""
Methods simbody_methods() { return {}; }
#endif

std::string power_of_ten(double tolerance) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.0e", tolerance);
  return text.data();
}

std::vector<Library> libraries() {
  return {{"Bullet", ACCURACY_COST_BULLET_VERSION}, {"FCL", ACCURACY_COST_FCL_VERSION}, {"Simbody", ACCURACY_COST_SIMBODY_VERSION}};
}

}  // namespace accuracy_cost
