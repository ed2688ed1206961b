// Registration of our geometry class with ODE, and the reference count on ODE that keeps the class alive.
#pragma once

#include <ode/ode.h>

#include <memory>

namespace supernormal::ode {

class Body;

/// The number of our class. The first call registers the class. Thread-safe. Throws std::runtime_error when ODE has another
/// precision than this library, cannot be initialised or has no free user class.
int require_geom_class();

/// Refuses a geom that is no space, at which ODE would end the program. Null is a space: none.
void require_space(dSpaceID space);

/// Creates a geom of our class that owns `body`. Adds it to `space` unless that is null. Throws std::invalid_argument if `space` is
/// no space, or a half-width of the body is outside [kMinLength, kMaxLength]: the core takes points, segments and flat shapes.
dGeomID create_geom(dSpaceID space, std::unique_ptr<Body> body);

}  // namespace supernormal::ode
