// The number of our geometry class in ODE, and the names of all classes.
#pragma once

#include <ode/ode.h>

#include <string>

namespace supernormal::ode {

/// The number of our class; -1 while it is not registered.
int geom_class() noexcept;

/// Sets the result of geom_class().
void set_geom_class(int number) noexcept;

/// A name for messages: "a dBox", "a geom of this library's class", ...
std::string geom_class_name(dGeomID geom);

}  // namespace supernormal::ode
