// The reason why a query of two geoms is refused.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Throws std::invalid_argument with the reason why the core answers Status::InvalidInput for two geoms.
[[noreturn]] void refuse_pair(dGeomID ours, dGeomID collider);

/// Throws std::invalid_argument for a collider of a class that no query takes.
[[noreturn]] void refuse_class(dGeomID collider);

}  // namespace supernormal::ode
