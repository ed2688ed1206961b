// The parts of the module supernormal._core.
#pragma once

#include <pybind11/pybind11.h>

namespace supernormal::python {

void bind_enums(pybind11::module_& m);
void bind_poses(pybind11::module_& m);
void bind_settings(pybind11::module_& m);
void bind_shapes(pybind11::module_& m);
void bind_composed_shapes(pybind11::module_& m);
void bind_shape_sequence(pybind11::module_& m);
void bind_descriptions(pybind11::module_& m);
void bind_proximity(pybind11::module_& m);
void bind_contact(pybind11::module_& m);
void bind_raycast(pybind11::module_& m);
void bind_impact(pybind11::module_& m);
void bind_derivatives(pybind11::module_& m);

}  // namespace supernormal::python
