// Why two geoms have no answer.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Throws std::invalid_argument with the reason why the core, which answers Status::InvalidInput, cannot compute with two geoms.
[[noreturn]] void refuse_pair(dGeomID ours, dGeomID collider);

}  // namespace supernormal::ode
