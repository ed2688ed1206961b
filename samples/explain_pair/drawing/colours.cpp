#include "drawing/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace explain_pair {
namespace {

constexpr Oklch kLowest{0.60, 0.075, 235}, kHighest{0.985, 0.02, 95};

double to_srgb(double linear) {
  const double value = std::clamp(linear, 0.0, 1.0);
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace

std::string hex(const Oklch& colour) {
  const double angle = colour.hue * std::numbers::pi / 180;
  const double a = colour.chroma * std::cos(angle), b = colour.chroma * std::sin(angle);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(colour.lightness + 0.3963377774 * a + 0.2158037573 * b);
  const double m = cube(colour.lightness - 0.1055613458 * a - 0.0638541728 * b);
  const double s = cube(colour.lightness - 0.0894841775 * a - 1.2914855480 * b);
  const std::array<double, 3> linear = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
  std::array<char, 8> text;
  const auto byte = [](double channel) { return static_cast<unsigned>(std::lround(255 * to_srgb(channel))); };
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", byte(linear[0]), byte(linear[1]), byte(linear[2]));
  return text.data();
}

// A straight line in OKLab: equal fractions are equal perceived distances.
Oklch map_colour(double share) {
  const auto a = [](const Oklch& colour) { return colour.chroma * std::cos(colour.hue * std::numbers::pi / 180); };
  const auto b = [](const Oklch& colour) { return colour.chroma * std::sin(colour.hue * std::numbers::pi / 180); };
  const double x = std::lerp(a(kLowest), a(kHighest), share), y = std::lerp(b(kLowest), b(kHighest), share);
  return {std::lerp(kLowest.lightness, kHighest.lightness, share), std::hypot(x, y), std::atan2(y, x) * 180 / std::numbers::pi};
}

}  // namespace explain_pair
