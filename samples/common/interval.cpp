#include "common/interval.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace common {

bool Interval::contains(double value) const {
  const bool above = includes_lower ? value >= lower : value > lower;
  const bool below = includes_upper ? value <= upper : value < upper;
  return std::isfinite(value) && above && below;
}

std::string Interval::describe() const {
  if (upper == std::numeric_limits<double>::max()) return std::string("a number: ") + unit;
  std::string text = "a number in ";
  text += includes_lower ? '[' : '(';
  text += shortest(lower) + ", " + shortest(upper);
  text += includes_upper ? ']' : ')';
  if (*unit != '\0') text += std::string(" ") + unit;
  return text;
}

std::string shortest(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string rounded(double value, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

std::string rounded_up(double value) {
  constexpr int kDigits = 6;
  const std::string nearest = rounded(value, kDigits);
  if (value == 0 || std::stod(nearest) >= value) return nearest;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - kDigits + 1);
  return rounded(value + unit / 2, kDigits);
}

std::string counted(std::size_t number, const std::string& noun) {
  return std::to_string(number) + ' ' + noun + (number == 1 ? "" : "s");
}

}  // namespace common
