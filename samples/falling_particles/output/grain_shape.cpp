#include "output/grain_shape.hpp"

#include <supernormal/shapes/rounded.hpp>
#include <supernormal/shapes/superellipsoid.hpp>

namespace falling_particles {

std::shared_ptr<const supernormal::Shape> shape_of(const Grain& grain) {
  const double r = grain.rounding;
  const auto& [a, b, c] = grain.half_axes;
  auto core = std::make_shared<supernormal::Superellipsoid>(supernormal::Vector3(a - r, b - r, c - r), grain.delta, grain.epsilon);
  if (r == 0) return core;
  return std::make_shared<supernormal::Rounded>(std::move(core), r);
}

}  // namespace falling_particles
