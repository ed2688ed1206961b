// The number of the one geometry class of this library inside ODE, and the names of all classes.
#pragma once

#include <ode/ode.h>

#include <string>

namespace supernormal::ode {

/// Our class number; -1 while the class is not registered.
int geom_class() noexcept;

/// Changes what geom_class() returns.
void set_geom_class(int number) noexcept;

/// A name for messages: "a dBox", "a geom of this library's class", ...
std::string geom_class_name(dGeomID geom);

}  // namespace supernormal::ode
