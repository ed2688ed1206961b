// The reason why a query of two geoms is refused.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Throws std::invalid_argument with the reason why the core answers Status::InvalidInput for two geoms. The names of the
/// caller's arguments are for the message; without them it has the classes only.
[[noreturn]] void refuse_pair(dGeomID ours, dGeomID collider, const char* our_name = nullptr, const char* collider_name = nullptr);

/// Throws std::invalid_argument for a collider of a class that no query takes.
[[noreturn]] void refuse_class(dGeomID collider, const char* name = "the collider");

}  // namespace supernormal::ode
