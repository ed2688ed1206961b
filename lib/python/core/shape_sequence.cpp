// Sequences of shapes, from arrays of parameters or from a list.
#include <pybind11/stl.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "pairs.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

/// Makes `count` shapes by `make(i)`. An error names the entry.
template <typename ShapeClass, typename Make>
std::shared_ptr<ShapeSequence> make_shapes(py::ssize_t count, const Make& make) {
  const auto owner = std::make_shared<std::vector<ShapeClass>>();
  owner->reserve(static_cast<std::size_t>(count));
  for (py::ssize_t i = 0; i < count; ++i) {
    try {
      owner->push_back(make(i));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("shape " + std::to_string(i) + ": " + error.what());
    }
  }
  std::vector<const Shape*> shapes;
  shapes.reserve(owner->size());
  for (const ShapeClass& shape : *owner) shapes.push_back(&shape);
  return std::make_shared<ShapeSequence>(owner, std::move(shapes));
}

std::shared_ptr<ShapeSequence> make_spheres(const Doubles& radius) {
  const py::ssize_t count = require_rows("radius", radius, {});
  return make_shapes<Sphere>(count, [&](py::ssize_t i) { return Sphere(radius.data()[i]); });
}

std::shared_ptr<ShapeSequence> make_ellipsoids(const Doubles& half_axes) {
  const py::ssize_t count = require_rows("half_axes", half_axes, {3});
  return make_shapes<Ellipsoid>(count, [&](py::ssize_t i) { return Ellipsoid(vector_at(half_axes.data() + 3 * i)); });
}

std::shared_ptr<ShapeSequence> make_superellipsoids(const Doubles& half_axes, const Doubles& delta, const Doubles& epsilon) {
  const py::ssize_t count = require_rows("half_axes", half_axes, {3});
  PairCount all;  // must agree with it
  all.add("half_axes", static_cast<std::size_t>(count));
  const NumbersArgument deltas("delta", delta, all), epsilons("epsilon", epsilon, all);
  return make_shapes<Superellipsoid>(
      count, [&](py::ssize_t i) { return Superellipsoid(vector_at(half_axes.data() + 3 * i), deltas[i], epsilons[i]); });
}

std::shared_ptr<ShapeSequence> make_superovoids(const Doubles& half_axes, const Doubles& delta, const Doubles& epsilon,
                                                const Doubles& taper_x, const Doubles& taper_y) {
  const py::ssize_t count = require_rows("half_axes", half_axes, {3});
  PairCount all;  // must agree with it
  all.add("half_axes", static_cast<std::size_t>(count));
  const NumbersArgument deltas("delta", delta, all), epsilons("epsilon", epsilon, all);
  const NumbersArgument tapers_x("taper_x", taper_x, all), tapers_y("taper_y", taper_y, all);
  return make_shapes<Superovoid>(count, [&](py::ssize_t i) {
    return Superovoid(vector_at(half_axes.data() + 3 * i), deltas[i], epsilons[i], tapers_x[i], tapers_y[i]);
  });
}

constexpr const char* kDoc =
    R"(N shapes, for find_proximities() and find_ray_hits().

The constructor takes a sequence of Shape. spheres(), ellipsoids(), superellipsoids() and superovoids() take arrays of parameters.
An entry is a Shape. A ValueError names the entry.)";

}  // namespace

std::shared_ptr<ShapeSequence> make_shape_sequence(const char* name, const py::sequence& shapes) {
  const auto owner = std::make_shared<std::vector<std::shared_ptr<Shape>>>();
  std::vector<const Shape*> pointers;
  for (const py::handle item : shapes) {
    if (!py::isinstance<Shape>(item)) {
      refuse_type(Name{name, static_cast<std::ptrdiff_t>(owner->size())}.text(), item, "a Shape");
    }
    owner->push_back(item.cast<std::shared_ptr<Shape>>());
    pointers.push_back(owner->back().get());
  }
  return std::make_shared<ShapeSequence>(owner, std::move(pointers));
}

void bind_shape_sequence(py::module_& m) {
  using Pointer = std::shared_ptr<ShapeSequence>;
  py::class_<ShapeSequence, Pointer> type(m, "Shapes", kDoc);
  type.def(py::init([](const py::sequence& shapes) { return make_shape_sequence("shapes", shapes); }), py::arg("shapes"))
      .def_static("spheres", &make_spheres, py::arg("radius"), "radius: (N,), m, in [0, 1e30]")
      .def_static("ellipsoids", &make_ellipsoids, py::arg("half_axes"), "half_axes: (N, 3), m, in [1e-30, 1e30]")
      .def_static("superellipsoids", &make_superellipsoids, py::arg("half_axes"), py::arg("delta"), py::arg("epsilon"),
                  "half_axes: (N, 3), m, in [1e-30, 1e30]; delta, epsilon: (N,) or a number, in [1.01, 1000]")
      .def_static("superovoids", &make_superovoids, py::arg("half_axes"), py::arg("delta"), py::arg("epsilon"), py::arg("taper_x"),
                  py::arg("taper_y"),
                  "half_axes: (N, 3), m, in [1e-30, 1e30]; the others: (N,) or a number; exponents in [1.01, 1000]; tapers such "
                  "that the body is convex; see Superovoid")
      .def("__len__", &ShapeSequence::size)
      .def("__getitem__",
           [](const ShapeSequence& self, std::ptrdiff_t i) { return self.share(require_index("shapes", i, self.size())); })
      .def("__repr__", [](const ShapeSequence& self) { return "Shapes(of " + std::to_string(self.size()) + " bodies)"; });
  bind_iteration(type);
  bind_value(
      type,
      [](const Pointer& self) {
        py::tuple shapes(self->size());
        for (std::size_t i = 0; i < self->size(); ++i) shapes[i] = self->share(i);
        return shapes;
      },
      [](const py::tuple& of) { return make_shape_sequence("shapes", of); });
}

}  // namespace supernormal::python
