#include "common/environment.hpp"

#include <Eigen/Core>
#include <array>
#include <cstdio>
#include <fstream>

namespace common {
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
  return __VERSION__;  // it names the compiler, too
#else
  return std::string("GCC ") + __VERSION__;
#endif
}

std::string eigen_version() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
         std::to_string(EIGEN_MINOR_VERSION);
}

std::string commit() {
  std::FILE* const pipe = popen("git -C '" COMMON_SOURCE "' describe --always --dirty 2>/dev/null", "r");
  if (pipe == nullptr) return "unknown";
  std::array<char, 128> text{};
  const bool found = std::fgets(text.data(), text.size(), pipe) != nullptr;
  pclose(pipe);
  std::string name = found ? text.data() : "unknown";
  if (name.ends_with('\n')) name.pop_back();
  return name;
}

}  // namespace

Environment environment() {
  return {{"processor", processor()},
          {"compiler", compiler()},
          {"build", COMMON_FLAGS},
          {"commit", commit()},
          {"Eigen", eigen_version()}};
}

}  // namespace common
