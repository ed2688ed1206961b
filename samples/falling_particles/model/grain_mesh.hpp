// Meshes of grains.
#pragma once

#include <supernormal/shapes/tessellation.hpp>

#include "grain_kind.hpp"

namespace falling_particles {

/// The mesh of a kind of grain in its own frame, with a closed mesh for each convex body. `chord_error`: relative to the smallest
/// half-axis of a body.
supernormal::Tessellation mesh_of(const GrainKind& kind, double chord_error);

}  // namespace falling_particles
