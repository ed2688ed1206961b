// Queries of any shape.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "supernormal/shapes/shape.hpp"
#include "supernormal/shapes/tessellation.hpp"

namespace supernormal::python {

void bind_shape_queries(pybind11::class_<Shape, std::shared_ptr<Shape>>& shape);

/// The inertia tensor about the centroid for density 1, m^5.
Matrix3 central_inertia(const MassProperties& properties);

/// Returns an array (N, 3).
pybind11::array_t<double> rows_of(const std::vector<Vector3>& points);

pybind11::array_t<std::uint32_t> triangles_of(const Tessellation& tessellation);

}  // namespace supernormal::python
