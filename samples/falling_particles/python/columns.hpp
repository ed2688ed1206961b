// What a world holds, as arrays of NumPy.
#pragma once

#include <pybind11/pybind11.h>

#include "run/stepwise_run.hpp"

namespace falling_particles::python {

/// Each function returns arrays by the names of the fields of the classes in scenes.py, where units and frames are.
pybind11::dict grains_of(const StepwiseRun& run);
pybind11::dict contacts_of(const StepwiseRun& run);
pybind11::dict walls_of(const StepwiseRun& run);

/// The kinds of grains, as dictionaries.
pybind11::list kinds_of(const Scene& scene);

}  // namespace falling_particles::python
