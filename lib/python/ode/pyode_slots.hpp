// Makes a geom of ours an object of PyODE.
#pragma once

#include <ode/ode.h>
#include <pybind11/pybind11.h>

namespace supernormal::python {

/// GeomObject of PyODE is a Cython class. Methods such as getPosition() and setBody() use a dGeomID in the object that no function
/// can set, at an unpublished offset. find_slots() finds this offset in an object with a known number. It refuses a PyODE in which
/// the offset is not unique. adopt() then writes our dGeomID into an object of a class derived from GeomObject. That object
/// destroys the geom like its own.
///
/// Likewise, find_contact() finds the dContact in a contact of PyODE, because PyODE does not set some of its parameters.
void bind_slots(pybind11::module_& m);

/// The dContact at the offset that find_contact() found.
dContact read_contact(const pybind11::handle& contact, pybind11::ssize_t offset);

}  // namespace supernormal::python
