#include "environment.hpp"

#include <Eigen/Core>
#include <fstream>

namespace accuracy_cost {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

std::string compiler() {
#if defined(__clang__)
  return __VERSION__;  // names itself
#else
  return std::string("GCC ") + __VERSION__;
#endif
}

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> environment() {
  return {{"processor", processor()},
          {"compiler", compiler()},
          {"build", ACCURACY_COST_FLAGS},
          {"Eigen", eigen_version()},
          {"libccd (by its ccd.pc)", ACCURACY_COST_CCD_VERSION}};
}

}  // namespace accuracy_cost
