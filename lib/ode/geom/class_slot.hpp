// ODE's table of user classes: taking a slot of it, and finding out whether ours is still registered.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Calls dCreateGeomClass, but returns -1 instead of calling abort() when the process has no slot left. ODE must be initialised.
int take_class_slot(const dGeomClass& geom_class);

/// Leaves a mark in ODE that vanishes when ODE is closed for good, by its last dCloseODE, and with it all user classes.
void mark_class_table();

/// Whether the mark is still there: the classes registered before it are still registered.
bool class_table_is_marked();

}  // namespace supernormal::ode
