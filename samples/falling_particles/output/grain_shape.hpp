// A grain as a shape of the library's core.
#pragma once

#include <memory>
#include <supernormal/shapes/shape.hpp>

#include "scene/grain.hpp"

namespace falling_particles {

/// The body that World::create_geom() makes of the grain.
std::shared_ptr<const supernormal::Shape> shape_of(const Grain& grain);

}  // namespace falling_particles
