// Registration of this library's geometry class with ODE, and the reference on ODE that keeps it alive.
#pragma once

#include <ode/ode.h>

#include <memory>

namespace supernormal::ode {

class Body;

/// Our class number; registers the class first if that has not happened yet. Any thread may call it. Throws std::runtime_error
/// when ODE has another precision than this library, cannot be initialised or has no free user class.
int require_geom_class();

/// Creates a geom of our class in `space` (or in none, when 0) that owns `body`.
dGeomID create_geom(dSpaceID space, std::unique_ptr<Body> body);

}  // namespace supernormal::ode
