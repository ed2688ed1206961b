#include "common/number_text.hpp"
#include "method.hpp"

namespace accuracy_cost {

using common::text;

// CMakeLists.txt defines the version of each library that it finds, and compiles its methods.

#ifndef ACCURACY_COST_BULLET_VERSION
#define ACCURACY_COST_BULLET_VERSION ""
Methods bullet_methods() { return {}; }
#endif

#ifndef ACCURACY_COST_FCL_VERSION
#define ACCURACY_COST_FCL_VERSION ""
Methods fcl_methods(Motion /*motion*/) { return {}; }
#endif

#ifndef ACCURACY_COST_SIMBODY_VERSION
#define ACCURACY_COST_SIMBODY_VERSION ""
Methods simbody_methods() { return {}; }
#endif

std::string power_of_ten(double tolerance) { return text("%.0e", tolerance); }

std::vector<Library> libraries() {
  return {{"Bullet", ACCURACY_COST_BULLET_VERSION}, {"FCL", ACCURACY_COST_FCL_VERSION}, {"Simbody", ACCURACY_COST_SIMBODY_VERSION}};
}

}  // namespace accuracy_cost
