#include "common/number_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace common {
namespace {

std::string print(const char* format, double value) {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, value);
  return buffer.data();
}

}  // namespace

std::string text(const char* format, double value) { return std::isnan(value) ? "–" : print(format, value); }

std::string number(double value) { return print("%.6g", value); }

}  // namespace common
