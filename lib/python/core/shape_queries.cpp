#include "shape_queries.hpp"

#include <algorithm>
#include <string>

#include "arrays.hpp"
#include "enums.hpp"
#include "parallel_for.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/shapes/silhouette.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

/// Calls write(i, direction) for each direction, normalised.
template <typename Write>
void for_each_direction(const Doubles& directions, const Write& write) {
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

}  // namespace

Matrix3 central_inertia(const MassProperties& properties) {
  const Matrix3 S = properties.second_moment - properties.volume * properties.centroid * properties.centroid.transpose();
  return S.trace() * Matrix3::Identity() - S;
}

py::array_t<double> rows_of(const std::vector<Vector3>& points) {
  py::array_t<double> out({static_cast<py::ssize_t>(points.size()), py::ssize_t{3}});
  double* to = out.mutable_data();
  for (const Vector3& p : points) to = std::copy(p.data(), p.data() + 3, to);
  return out;
}

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
      .def("mass_properties", &Shape::mass_properties,
           "Volume, centroid and second moments: in closed form if there is one, otherwise by quadrature over the normals.\n"
           "The relative_error of the quadrature accounts for the volume behind flat faces.\n\n"
           "Raises ValueError when the shape returns a number that is not finite.")
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

}  // namespace supernormal::python
