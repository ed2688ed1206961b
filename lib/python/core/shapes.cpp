// Shape, and the shapes with explicit parameters.
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "bindings.hpp"
#include "enums.hpp"
#include "parallel_for.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/silhouette.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "supernormal/shapes/superellipsoid.hpp"
#include "supernormal/shapes/superovoid.hpp"
#include "supernormal/shapes/tessellation.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

/// Calls write(i, direction) for each direction, normalised.
void for_each_direction(const Doubles& directions, const auto& write) {
  const py::ssize_t count = require_vectors("direction", directions);
  for (py::ssize_t i = 0; i < count; ++i) {
    const Name name{"direction", directions.ndim() == 1 ? -1 : i};
    write(i, require_direction(name, vector_at(directions.data() + 3 * i)));
  }
}

py::array_t<double> support(const Shape& self, const Doubles& directions) {
  require_vectors("direction", directions);
  py::array_t<double> out(leading_shape(directions, {}));
  for_each_direction(directions, [&](py::ssize_t i, const Vector3& n) { out.mutable_data()[i] = self.support(n); });
  return out;
}

py::array_t<double> point(const Shape& self, const Doubles& directions) {
  require_vectors("direction", directions);
  py::array_t<double> out(leading_shape(directions, {3}));
  for_each_direction(directions, [&](py::ssize_t i, const Vector3& n) {
    const Vector3 r = self.point(n);
    std::copy(r.data(), r.data() + 3, out.mutable_data() + 3 * i);
  });
  return out;
}

py::array_t<double> hessian(const Shape& self, const Doubles& directions) {
  if (!self.traits().has_hessian) throw std::invalid_argument("the shape has no Hessian (has_hessian is False)");
  require_vectors("direction", directions);
  py::array_t<double> out(leading_shape(directions, {3, 3}));
  for_each_direction(directions, [&](py::ssize_t i, const Vector3& n) { write_matrix(self.jet(n).H, out.mutable_data() + 9 * i); });
  return out;
}

/// The extent along a world axis is the support function in this direction, in the body's frame.
py::tuple parameter_names(const Shape& shape) {
  ParameterGradient gradient;
  const Vector3 n = Vector3::UnitZ();
  shape.add_parameter_gradient(n, shape.point(n), gradient);
  py::tuple names(gradient.size());
  for (std::size_t k = 0; k < gradient.size(); ++k) names[k] = py::str(gradient[k].name);
  return names;
}

py::array_t<double> bounding_box(const Shape& self, const Pose& pose) {
  py::array_t<double> out({py::ssize_t{2}, py::ssize_t{3}});
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 n = pose.rotation.row(axis).transpose();
    out.mutable_at(0, axis) = pose.position[axis] - self.support(-n);
    out.mutable_at(1, axis) = pose.position[axis] + self.support(n);
  }
  return out;
}

py::array_t<double> signed_distance(const Shape& self, const Doubles& points, const Pose& pose, const Settings& settings,
                                    int threads) {
  const py::ssize_t count = require_vectors("point", points);
  for (py::ssize_t i = 0; i < count; ++i) require_place({"point", points.ndim() == 1 ? -1 : i}, vector_at(points.data() + 3 * i));
  py::array_t<double> out(leading_shape(points, {}));
  const double* const from = points.data();
  double* const to = out.mutable_data();
  const Sphere a_point(0);
  parallel_for(count, threads, [&](std::ptrdiff_t i) {
    const Proximity result = find_proximity(self, pose, a_point, {vector_at(from + 3 * i), Matrix3::Identity()}, settings);
    if (result.status == Status::InvalidInput) throw std::invalid_argument(kNotFinite);
    to[i] = result.gap;
  });
  return out;
}

constexpr const char* kSignedDistanceDoc =
    R"(The signed distance of points from the boundary, m: (...); positive outside, negative inside.

point: (..., 3), m, in the world frame, within 1e150.
pose: of the body.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Raises ValueError for points or settings out of range.)";

constexpr const char* kTessellateDoc = R"(A closed mesh of the body. Its edges are within chord_error of the boundary.

chord_error: m, at least 1e-6 of the largest half-extent; ValueError otherwise.)";

py::array_t<std::uint32_t> triangles_of(const Tessellation& tessellation) {
  py::array_t<std::uint32_t> out({static_cast<py::ssize_t>(tessellation.triangles.size()), py::ssize_t{3}});
  std::uint32_t* to = out.mutable_data();
  for (const auto& triangle : tessellation.triangles) to = std::copy(triangle.begin(), triangle.end(), to);
  return out;
}

void bind_shape_queries(py::class_<Shape, std::shared_ptr<Shape>>& shape) {
  shape
      .def("support", &support, py::arg("direction"),
           "The support function h(n), m: (...).\n\ndirection: (..., 3), body's frame, any length but 0; ValueError otherwise.")
      .def("point", &point, py::arg("direction"),
           "The boundary points r(n) with these outward normals n, m: (..., 3), body's frame.\n\n"
           "direction: (..., 3), body's frame, any length but 0; ValueError otherwise.")
      .def("hessian", &hessian, py::arg("direction"),
           "The Hessians of h at unit normals n, m: (..., 3, 3). Their eigenvalues perpendicular to n are the radii of "
           "curvature.\n\n"
           "direction: (..., 3), body's frame, any length but 0; ValueError otherwise, or if has_hessian is false.")
      .def_property_readonly(
          "has_hessian", [](const Shape& self) { return self.traits().has_hessian; }, "Whether hessian() is available.")
      .def_property_readonly(
          "is_smooth", [](const Shape& self) { return !self.traits().has_nonsmooth_points; },
          "Whether h is differentiable: no flat face, no straight edge. Pairs of other shapes are solved by Solver.HYBRID.")
      .def_property_readonly("half_extents", &Shape::half_extents, "(3,), m; half of the extent along the axes of the body's frame")
      .def_property_readonly(
          "is_symmetric", [](const Shape& self) { return self.traits().is_symmetric; },
          "Whether the body is point-symmetric about its origin. False if unknown.")
      .def_property_readonly("rolling_radius", &Shape::rolling_radius,
                             "m; a ball of this radius provably rolls freely inside the body; 0 if unknown")
      .def_property_readonly(
          "parameter_names", &parameter_names,
          "The names of the shape's parameters, in the order of ProximityDerivatives.parameters1. The radius of a "
          "Rounded follows the parameters of its core.")
      .def("bounding_box", &bounding_box, py::arg("pose") = Pose(),
           "The smallest axis-aligned box in the world frame, m: (2, 3), its lower and its upper corner.")
      .def(
          "mass_properties",
          [](const Shape& self) {
            const MassProperties mass = self.mass_properties();
            require_known(mass, "the shape");
            return mass;
          },
          "Volume, centroid and second moments: in closed form if there is one, otherwise by quadrature over the normals.\n\n"
          "Raises ValueError when the quadrature misses more than 1 % of the volume, behind flat faces, or when the shape returns "
          "a number that is not finite.")
      .def("surface_area", &surface_area, "m^2; accurate to 1e-3 for bodies with aspect ratios up to 5")
      .def(
          "projected_area",
          [](const Shape& self, const Vector3& direction) {
            return projected_area(self, require_direction({"direction"}, direction));
          },
          py::arg("direction"),
          "The area of the body's projection along a direction, m^2; exact for ellipsoids, 0.3 % too large for a box.\n\n"
          "direction: (3,), body's frame, any length but 0; ValueError otherwise.")
      .def("signed_distance", &signed_distance, py::arg("point"), py::arg("pose") = Pose(), py::arg("settings") = Settings(),
           py::arg("threads") = 0, kSignedDistanceDoc)
      .def(
          "tessellate", [](const Shape& self, double chord_error) { return tessellate(self, chord_error); }, py::arg("chord_error"),
          kTessellateDoc);
}

constexpr const char* kSuperovoidDoc =
    R"(A superellipsoid whose section grows or shrinks linearly along z: with X = 1 + taper_x z/c and Y = 1 + taper_y z/c,
(|x/(a X)|^delta + |y/(b Y)|^delta)^(epsilon/delta) + |z/c|^epsilon = 1 in the body's frame.

half_axes: (3,): a, b, c, m, in [1e-30, 1e30].
delta, epsilon: in [1.01, 1000].
taper_x, taper_y: within max_taper(epsilon), such that the body is convex. For epsilon > 2 they must be equal. For epsilon <= 2
different tapers are bounded together.

Raises ValueError with the condition that fails. With a taper the centroid is not the origin of the frame.)";

void bind_round_shapes(py::module_& m) {
  bind_shape<Sphere>(m, "Sphere", "A sphere, or a point if the radius is 0.\n\nradius: m, in [0, 1e30]; ValueError otherwise.",
                     Field{"radius", &Sphere::radius, "m"});
  bind_shape<Ellipsoid>(m, "Ellipsoid",
                        "(x/a)^2 + (y/b)^2 + (z/c)^2 = 1 in the body's frame.\n\n"
                        "half_axes: (3,): a, b, c, m, in [1e-30, 1e30]; ValueError otherwise.",
                        Field{"half_axes", &Ellipsoid::half_axes, "(3,), m"});
  bind_shape<Superellipsoid>(m, "Superellipsoid",
                             "(|x/a|^delta + |y/b|^delta)^(epsilon/delta) + |z/c|^epsilon = 1 in the body's frame: from an\n"
                             "octahedron (exponents near 1) through the ellipsoid (2) to a box (large exponents).\n\n"
                             "half_axes: (3,): a, b, c, m, in [1e-30, 1e30]; delta, epsilon in [1.01, 1000]; ValueError otherwise.",
                             Field{"half_axes", &Superellipsoid::half_axes, "(3,), m"},
                             Field{"delta", &Superellipsoid::delta, "the exponent in the xy-section"},
                             Field{"epsilon", &Superellipsoid::epsilon, "the exponent along z"});
  bind_shape<Superovoid>(m, "Superovoid", kSuperovoidDoc,
                         Field{"half_axes", &Superovoid::half_axes, "(3,), m; half-axes of the superellipsoid before the taper"},
                         Field{"delta", &Superovoid::delta, "the exponent in the xy-section"},
                         Field{"epsilon", &Superovoid::epsilon, "the exponent along z"},
                         Field{"taper_x", &Superovoid::taper_x, "relative growth of the half-axis a from z = 0 to z = c"},
                         Field{"taper_y", &Superovoid::taper_y, "relative growth of the half-axis b from z = 0 to z = c"})
      .def_static("max_taper", &Superovoid::max_taper, py::arg("epsilon"),
                  "The largest |taper| of a convex body with equal tapers: 2^(1/epsilon) (epsilon - 1)/epsilon.");
}

void bind_shapes_with_edges(py::module_& m) {
  bind_shape<Box>(m, "Box", "|x| <= a, |y| <= b, |z| <= c.\n\nhalf_lengths: (3,): a, b, c, m, in [0, 1e30]; ValueError otherwise.",
                  Field{"half_lengths", &Box::half_lengths, "(3,), m"});
  bind_shape<Capsule>(m, "Capsule",
                      "The points within `radius` of the segment from (0, 0, -half_length) to (0, 0, half_length).\n\n"
                      "radius, half_length: m, in [0, 1e30]; ValueError otherwise.",
                      Field{"radius", &Capsule::radius, "m"}, Field{"half_length", &Capsule::half_length, "m"});
  bind_shape<Cylinder>(m, "Cylinder",
                       "x^2 + y^2 <= radius^2, |z| <= half_length.\n\n"
                       "radius, half_length: m, in [0, 1e30]; ValueError otherwise.",
                       Field{"radius", &Cylinder::radius, "m"}, Field{"half_length", &Cylinder::half_length, "m"});
}

void bind_mass_properties(py::module_& m) {
  py::class_<MassProperties> type(m, "MassProperties", "Volume integrals of a homogeneous body of density one, in its own frame.");
  type.def_property_readonly("inertia", &MassProperties::inertia,
                             "(3, 3), m^5; inertia tensor about the centroid for density 1; multiply by kg/m^3 for kg m^2");
  bind_arguments(
      type, maker<decltype(type), double, Vector3, Matrix3, double>(), Field{"volume", &MassProperties::volume, "m^3"},
      Field{"centroid", &MassProperties::centroid, "(3,), m"},
      Field{"second_moment", &MassProperties::second_moment, "(3, 3), m^5; the integral of x x^T about the origin of the frame"},
      Field{"relative_error", &MassProperties::relative_error,
            "estimated relative error of volume and moments; 0 for closed forms"});
}

void bind_tessellation(py::module_& m) {
  py::class_<Tessellation> type(m, "Tessellation", "A closed mesh whose vertices are boundary points of a body.");
  bind_fields(
      type, Field{"points", [](const Tessellation& self) { return rows_of(self.points); }, "(N, 3), m, in the body's frame"},
      Field{"normals", [](const Tessellation& self) { return rows_of(self.normals); }, "(N, 3), unit, outward; at the points"},
      Field{"triangles", &triangles_of, "(M, 3) of uint32: indices of points, anticlockwise from outside"});
  type.def("__repr__", [](const Tessellation& self) {
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
  bind_shapes_with_edges(m);
}

}  // namespace supernormal::python
