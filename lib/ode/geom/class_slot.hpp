// The user classes of ODE: takes a slot, and tests whether our class is still registered.
#pragma once

#include <ode/ode.h>

namespace supernormal::ode {

/// Calls dCreateGeomClass. Returns -1 instead of calling abort() when all slots are taken. ODE must be initialised.
int take_class_slot(const dGeomClass& geom_class);

/// Marks the class table of ODE. The last dCloseODE removes the mark together with all user classes.
void mark_class_table();

/// Whether the mark is still there. If so, the classes registered before it are, too.
bool class_table_is_marked();

}  // namespace supernormal::ode
