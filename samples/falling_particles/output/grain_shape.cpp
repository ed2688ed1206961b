#include "output/grain_shape.hpp"

#include <supernormal/shapes/rounded.hpp>
#include <supernormal/shapes/superellipsoid.hpp>

namespace falling_particles {

std::shared_ptr<const supernormal::Shape> shape_of(const Grain& grain) {
  const auto [a, b, c] = grain.core_half_axes();
  auto core = std::make_shared<supernormal::Superellipsoid>(supernormal::Vector3(a, b, c), grain.delta, grain.epsilon);
  if (grain.rounding == 0) return core;
  return std::make_shared<supernormal::Rounded>(std::move(core), grain.rounding);
}

}  // namespace falling_particles
