// The number of our geometry class in ODE, its slot there, and the names of all classes.
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

/// Calls dCreateGeomClass. Returns -1 instead of calling abort() when all slots are taken. ODE must be initialised.
int take_class_slot(const dGeomClass& geom_class);

/// Marks the class table of ODE. The last dCloseODE removes the mark together with all user classes.
void mark_class_table();

/// Whether the mark is still there. If so, the classes registered before it are, too.
bool class_table_is_marked();

}  // namespace supernormal::ode
