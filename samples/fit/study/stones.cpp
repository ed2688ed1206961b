#include "stones.hpp"

#include <cmath>
#include <random>

#include "kind/grain_kind.hpp"
#include "random_body.hpp"
#include "truth.hpp"

namespace fit {

std::vector<Body> make_stones(std::size_t count, std::uint64_t seed) {
  NormalNumbers normal(seed);
  std::mt19937_64 random(seed);
  std::vector<Body> stones;
  for (std::size_t i = 0; i < count; ++i) {
    Body stone = random_superellipsoid(random);
    const double b = normal(), c = normal(), delta = normal(), epsilon = normal(), size = normal();
    stone.half_axes = {1, 0.8 + 0.05 * b, 0.6 + 0.04 * c};
    stone.delta = 1 + 1.4 * std::exp(0.1 * delta);
    stone.epsilon = 1 + 1.8 * std::exp(0.1 * epsilon);
    stone.half_axes *= 0.01 * std::pow(1.25, size) / size_of(stone);
    stones.push_back(stone);
  }
  return stones;
}

}  // namespace fit
