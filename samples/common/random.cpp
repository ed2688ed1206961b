#include "common/random.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace common {

double Random::uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

std::uint64_t Random::below(std::uint64_t end) {
  const std::uint64_t biased =
      (~end + 1) % end;  // 2^64 mod end, the number of draws to reject: with them small results would be more likely
  std::uint64_t draw = engine_();
  while (draw < biased) draw = engine_();
  return draw % end;
}

std::array<double, 4> Random::rotation() {
  // K. Shoemake, Uniform random rotations, Graphics Gems III (1992), 124-132.
  const double u = uniform();
  const double first = 2 * std::numbers::pi * uniform();
  const double second = 2 * std::numbers::pi * uniform();
  const double s = std::sqrt(1 - u);
  const double t = std::sqrt(u);
  return {t * std::cos(second), s * std::sin(first), s * std::cos(first), t * std::sin(second)};
}

std::string Random::state() const {
  std::ostringstream text;
  text << engine_;
  return text.str();
}

void Random::restore(const std::string& state) { std::istringstream(state) >> engine_; }

}  // namespace common
