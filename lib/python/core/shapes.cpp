// Shape, and the shapes with explicit parameters.
#include <pybind11/stl.h>

#include <memory>
#include <string>

#include "arrays.hpp"
#include "bindings.hpp"
#include "shape_queries.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

template <typename ShapeClass>
using ShapeBinding = py::class_<ShapeClass, Shape, std::shared_ptr<ShapeClass>>;

void bind_round_shapes(py::module_& m) {
  ShapeBinding<Sphere> sphere(m, "Sphere",
                              "A sphere, or a point if the radius is 0.\n\nradius: m, in [0, 1e30]; ValueError otherwise.");
  sphere.def(py::init<double>(), py::arg("radius")).def_property_readonly("radius", &Sphere::radius, "m");
  bind_value(
      sphere, {"radius"}, [](const std::shared_ptr<Sphere>& self) { return py::make_tuple(self->radius()); },
      constructor<Sphere, double>());
  ShapeBinding<Ellipsoid> ellipsoid(m, "Ellipsoid",
                                    "(x/a)^2 + (y/b)^2 + (z/c)^2 = 1 in the body's frame.\n\n"
                                    "half_axes: (3,): a, b, c, m, in [1e-30, 1e30]; ValueError otherwise.");
  ellipsoid.def(py::init<const Vector3&>(), py::arg("half_axes"))
      .def_property_readonly(
          "half_axes", [](const Ellipsoid& self) { return self.half_axes(); }, "(3,), m");
  bind_value(
      ellipsoid, {"half_axes"}, [](const std::shared_ptr<Ellipsoid>& self) { return py::make_tuple(plain(self->half_axes())); },
      constructor<Ellipsoid, Vector3>());
}

void bind_superellipsoid(py::module_& m) {
  ShapeBinding<Superellipsoid> type(
      m, "Superellipsoid",
      "(|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon = 1 in the body's frame: from an\n"
      "octahedron (exponents near 1) through the ellipsoid (2) to a box (large exponents).\n\n"
      "half_axes: (3,): a, b, c, m, in [1e-30, 1e30]; delta, epsilon in [1.01, 1000]; ValueError otherwise.");
  type.def(py::init<const Vector3&, double, double>(), py::arg("half_axes"), py::arg("delta"), py::arg("epsilon"))
      .def_property_readonly(
          "half_axes", [](const Superellipsoid& self) { return self.half_axes(); }, "(3,), m")
      .def_property_readonly("delta", &Superellipsoid::delta, "the exponent in the xy-section")
      .def_property_readonly("epsilon", &Superellipsoid::epsilon, "the exponent along z");
  bind_value(
      type, {"half_axes", "delta", "epsilon"},
      [](const std::shared_ptr<Superellipsoid>& self) {
        return py::make_tuple(plain(self->half_axes()), self->delta(), self->epsilon());
      },
      constructor<Superellipsoid, Vector3, double, double>());
}

constexpr const char* kSuperovoidDoc =
    R"(A superellipsoid whose section grows or shrinks linearly along z: with X = 1 + taper_x z/c and Y = 1 + taper_y z/c,
(|x/(a X)|^delta + |y/(b Y)|^delta)^(epsilon/delta) + |z/c|^epsilon = 1 in the body's frame.

half_axes: (3,): a, b, c, m, in [1e-30, 1e30].
delta, epsilon: in [1.01, 1000].
taper_x, taper_y: within max_taper(epsilon), such that the body is convex. For epsilon > 2 they must be equal. For epsilon <= 2
different tapers are bounded together.

Raises ValueError with the condition that fails. With a taper the centroid is not the origin of the frame.)";

void bind_superovoid(py::module_& m) {
  ShapeBinding<Superovoid> type(m, "Superovoid", kSuperovoidDoc);
  type.def(py::init<const Vector3&, double, double, double, double>(), py::arg("half_axes"), py::arg("delta"), py::arg("epsilon"),
           py::arg("taper_x"), py::arg("taper_y"))
      .def_static("max_taper", &Superovoid::max_taper, py::arg("epsilon"),
                  "The largest |taper| of a convex body with equal tapers: 2^(1/epsilon) (epsilon - 1)/epsilon.")
      .def_property_readonly(
          "half_axes", [](const Superovoid& self) { return self.half_axes(); },
          "(3,), m; half-axes of the superellipsoid before the taper")
      .def_property_readonly("delta", &Superovoid::delta, "the exponent in the xy-section")
      .def_property_readonly("epsilon", &Superovoid::epsilon, "the exponent along z")
      .def_property_readonly("taper_x", &Superovoid::taper_x, "relative growth of the half-axis a from z = 0 to z = c")
      .def_property_readonly("taper_y", &Superovoid::taper_y, "relative growth of the half-axis b from z = 0 to z = c");
  bind_value(
      type, {"half_axes", "delta", "epsilon", "taper_x", "taper_y"},
      [](const std::shared_ptr<Superovoid>& self) {
        return py::make_tuple(plain(self->half_axes()), self->delta(), self->epsilon(), self->taper_x(), self->taper_y());
      },
      constructor<Superovoid, Vector3, double, double, double, double>());
}

/// Capsule and Cylinder have the same parameters.
template <typename ShapeClass>
void bind_of_radius_and_half_length(py::module_& m, const char* name, const char* doc) {
  ShapeBinding<ShapeClass> type(m, name, doc);
  type.def(py::init<double, double>(), py::arg("radius"), py::arg("half_length"))
      .def_property_readonly("radius", &ShapeClass::radius, "m")
      .def_property_readonly("half_length", &ShapeClass::half_length, "m");
  bind_value(
      type, {"radius", "half_length"},
      [](const std::shared_ptr<ShapeClass>& self) { return py::make_tuple(self->radius(), self->half_length()); },
      constructor<ShapeClass, double, double>());
}

void bind_shapes_with_edges(py::module_& m) {
  ShapeBinding<Box> box(m, "Box",
                        "|x| <= a, |y| <= b, |z| <= c.\n\nhalf_lengths: (3,): a, b, c, m, in [0, 1e30]; ValueError otherwise.");
  box.def(py::init<const Vector3&>(), py::arg("half_lengths"))
      .def_property_readonly(
          "half_lengths", [](const Box& self) { return self.half_lengths(); }, "(3,), m");
  bind_value(
      box, {"half_lengths"}, [](const std::shared_ptr<Box>& self) { return py::make_tuple(plain(self->half_lengths())); },
      constructor<Box, Vector3>());
  bind_of_radius_and_half_length<Capsule>(
      m, "Capsule",
      "The points within `radius` of the segment from (0, 0, -half_length) to (0, 0, half_length).\n\n"
      "radius, half_length: m, in [0, 1e30]; ValueError otherwise.");
  bind_of_radius_and_half_length<Cylinder>(m, "Cylinder",
                                           "x^2 + y^2 <= radius^2, |z| <= half_length.\n\n"
                                           "radius, half_length: m, in [0, 1e30]; ValueError otherwise.");
}

void bind_mass_properties(py::module_& m) {
  py::class_<MassProperties> type(m, "MassProperties", "Volume integrals of a homogeneous body of density one, in its own frame.");
  type.def_readonly("volume", &MassProperties::volume, "m^3")
      .def_property_readonly(
          "centroid", [](const MassProperties& self) { return self.centroid; }, "(3,), m")
      .def_property_readonly(
          "second_moment", [](const MassProperties& self) { return self.second_moment; },
          "(3, 3), m^5; the integral of x x^T about the origin of the frame")
      .def_property_readonly("inertia", &central_inertia,
                             "(3, 3), m^5; inertia tensor about the centroid for density 1; multiply by kg/m^3 for kg m^2")
      .def_readonly("relative_error", &MassProperties::relative_error,
                    "estimated relative error of volume and moments; 0 for closed forms");
  bind_value(
      type, {"volume", "centroid", "second_moment", "relative_error"},
      [](const MassProperties& self) {
        return py::make_tuple(self.volume, plain(self.centroid), plain(self.second_moment), self.relative_error);
      },
      [](const py::tuple& of) {
        MassProperties made;
        made.volume = of[0].cast<double>();
        made.centroid = of[1].cast<Vector3>();
        made.second_moment = of[2].cast<Matrix3>();
        made.relative_error = of[3].cast<double>();
        return made;
      });
}

void bind_tessellation(py::module_& m) {
  py::class_<Tessellation> type(m, "Tessellation", "A closed mesh whose vertices are boundary points of a body.");
  type.def_property_readonly(
          "points", [](const Tessellation& self) { return rows_of(self.points); }, "(N, 3), m, in the body's frame")
      .def_property_readonly(
          "normals", [](const Tessellation& self) { return rows_of(self.normals); }, "(N, 3), unit, outward; at the points")
      .def_property_readonly("triangles", &triangles_of, "(M, 3) of uint32: indices of points, anticlockwise from outside")
      .def("__repr__", [](const Tessellation& self) {
        return "Tessellation(of " + std::to_string(self.points.size()) + " points and " + std::to_string(self.triangles.size()) +
               " triangles)";
      });
  bind_copies(
      type,
      [](const Tessellation& self) {
        return py::make_tuple(py::cast(self.points), py::cast(self.normals), py::cast(self.triangles));
      },
      [](const py::tuple& of) {
        return Tessellation{of[0].cast<decltype(Tessellation::points)>(), of[1].cast<decltype(Tessellation::normals)>(),
                            of[2].cast<decltype(Tessellation::triangles)>()};
      });
}

constexpr const char* kShapeDoc =
    R"(A convex body, defined by its support function h(n) and the boundary point r(n) for each outward normal n.

Shapes are immutable. Any number of threads may use them.)";

}  // namespace

void bind_shapes(py::module_& m) {
  bind_mass_properties(m);
  bind_tessellation(m);
  py::class_<Shape, std::shared_ptr<Shape>> shape(m, "Shape", kShapeDoc);
  bind_shape_queries(shape);
  bind_round_shapes(m);
  bind_superellipsoid(m);
  bind_superovoid(m);
  bind_shapes_with_edges(m);
}

}  // namespace supernormal::python
