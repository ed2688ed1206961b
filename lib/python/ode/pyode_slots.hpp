// How a geom of ours becomes an object of PyODE's.
#pragma once

#include <pybind11/pybind11.h>

namespace supernormal::python {

/// PyODE's GeomObject is a class of Cython's: methods such as getPosition() and setBody() work on a dGeomID that lies in the object
/// and that no function sets. Where it lies is not published, so find_slots() looks for it in an object whose number is known, and
/// refuses a PyODE where the answer is not unique. adopt() then writes it into an object of a class that derives from GeomObject,
/// which destroys the geom as it destroys its own.
///
/// In the same way find_contact() looks for the dContact in a contact of PyODE's, some of whose parameters PyODE does not set.
void bind_slots(pybind11::module_& m);

}  // namespace supernormal::python
