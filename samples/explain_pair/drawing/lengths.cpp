#include "drawing/lengths.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace explain_pair {

std::string length_text(double metres, int digits) {
  struct Unit {
    double metres;
    const char* name;
  };
  constexpr std::array<Unit, 3> kUnits = {{{1, "m"}, {1e-3, "mm"}, {1e-6, "µm"}}};
  const double size = std::abs(metres);
  Unit unit = kUnits[0];
  if (size > 0 && size < 0.1 && size >= 1e-4) unit = kUnits[1];
  if (size > 0 && size < 1e-4 && size >= 1e-7) unit = kUnits[2];
  std::array<char, 48> buffer;
  std::snprintf(buffer.data(), buffer.size(), "%.*g %s", digits, metres / unit.metres, unit.name);
  std::string text = buffer.data();
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

}  // namespace explain_pair
