// Grains as meshes.
#pragma once

#include <supernormal/shapes/tessellation.hpp>

#include "model/grain_kind.hpp"

namespace falling_particles {

/// A mesh of a grain in its own frame, closed for each of its bodies. `chord_error`: relative to the smallest half-axis of a body.
supernormal::Tessellation mesh_of(const GrainKind& kind, double chord_error);

}  // namespace falling_particles
