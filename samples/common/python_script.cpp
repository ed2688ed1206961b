#include "common/python_script.hpp"

#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace common {

void become_python(const std::string& script, const std::string& argument) {
  constexpr const char* kPython = "/usr/bin/python3";  // of Debian, which packs matplotlib for it
  execl(kPython, kPython, script.c_str(), argument.c_str(), nullptr);
  throw std::runtime_error("no report: cannot run " + std::string(kPython) + ": " + std::generic_category().message(errno));
}

}  // namespace common
