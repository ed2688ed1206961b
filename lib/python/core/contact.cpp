// Contact manifolds and curvatures.
#include <pybind11/stl.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "enums.hpp"
#include "supernormal/contact/contact_curvature.hpp"
#include "supernormal/contact/contact_manifold.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

py::array_t<double> corner_points(const ContactManifold& self) {
  py::array_t<double> out({py::ssize_t{self.corner_count}, py::ssize_t{3}});
  double* to = out.mutable_data();
  for (std::size_t k = 0; k < static_cast<std::size_t>(self.corner_count); ++k) {
    to = std::copy(self.corners[k].point.data(), self.corners[k].point.data() + 3, to);
  }
  return out;
}

py::array_t<double> corner_depths(const ContactManifold& self) {
  py::array_t<double> out(py::ssize_t{self.corner_count});
  for (std::size_t k = 0; k < static_cast<std::size_t>(self.corner_count); ++k) out.mutable_data()[k] = self.corners[k].depth;
  return out;
}

/// The contacts that the ODE layer makes of a manifold (lib/ode/colliders/contact.cpp).
py::tuple contacts(const ContactManifold& self, int room) {
  if (room < 1) throw std::invalid_argument("room = " + std::to_string(room) + " is outside [1, inf)");
  ContactManifold reduced = reduced_to(self, room);
  if (!(self.deepest.gap <= 0)) {
    reduced.corner_count = 0;
  } else if (reduced.corner_count == 0) {
    reduced.corners[0] = {self.deepest.contact, 0 - self.deepest.gap};
    reduced.corner_count = 1;
  }
  return py::make_tuple(corner_points(reduced), corner_depths(reduced));
}

py::tuple arguments_of(const ContactManifold& self) {
  py::tuple corners(static_cast<std::size_t>(self.corner_count));
  for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = py::make_tuple(plain(self.corners[k].point), self.corners[k].depth);
  return py::make_tuple(self.deepest, corners, self.same_place, self.margin, self.evaluations);
}

ContactManifold make_manifold(const py::tuple& of) {
  ContactManifold made(of[0].cast<Proximity>());
  const auto corners = of[1].cast<std::vector<std::pair<Vector3, double>>>();
  if (corners.size() > made.corners.size()) throw std::invalid_argument("a manifold has at most 4 corners");
  for (std::size_t k = 0; k < corners.size(); ++k) made.corners[k] = {corners[k].first, corners[k].second};
  made.corner_count = static_cast<int>(corners.size());
  made.same_place = of[2].cast<double>();
  made.margin = of[3].cast<double>();
  made.evaluations = of[4].cast<int>();
  return made;
}

constexpr const char* kManifoldDoc =
    R"(The deepest point of an overlap and, where the bodies are flat, the corners of their contact region. Frame: world.

The manifold is a continuous function of the poses. Swapping the bodies does not change it.)";

constexpr const char* kContactsDoc =
    R"(The contacts for a simulator that accepts at most `room` contacts: points (K, 3), m, and depths (K,), m, as a tuple.

room: in [1, inf); ValueError otherwise. Round bodies have one contact; flat bodies have up to four corners, deepest first. Bodies
that are apart have none. All contacts have the normal deepest.normal.)";

constexpr const char* kFindManifoldDoc = R"(The contact manifold of two bodies with a known proximity.

proximity: the result of find_proximity() for the same bodies and poses.)";

constexpr const char* kFindPlaneDoc = R"(The contact manifold of a body and a plane.

proximity: the result of find_plane_proximity() for the same body and pose.)";

constexpr const char* kCurvatureDoc =
    R"(The curvature tensor of the boundary at the point with this outward normal, 1/m: (3, 3), the inverse of the Hessian.

normal: (3,), world frame, any length but 0; ValueError otherwise.)";

constexpr const char* kContactCurvatureDoc =
    R"(The principal relative curvatures of two bodies at a contact, 1/m: (smaller, larger).

The gap grows as (smaller x^2 + larger y^2) / 2 about the contact. normal: (3,), world frame, from body 1 to body 2, any length but
0; ValueError otherwise.)";

}  // namespace

void bind_contact(py::module_& m) {
  py::class_<ContactManifold> type(m, "ContactManifold", kManifoldDoc);
  bind_fields(type, Field{"deepest", &ContactManifold::deepest, "Proximity: the deepest point"},
              Field{"corner_points", &corner_points, "(K, 3), m, K = 0 or 4; some may coincide"},
              Field{"corner_depths", &corner_depths, "(K,), m; depth of the overlap at the corners, at least 0"},
              Field{"margin", &ContactManifold::margin, "m; upper bound of the gap between the bodies at a corner"},
              Field{"same_place", &ContactManifold::same_place, "m; corners closer than this are one contact"},
              Field{"evaluations", &ContactManifold::evaluations, "boundary points evaluated to find the corners"});
  type.def("contacts", &contacts, py::arg("room") = 8, kContactsDoc).def("__repr__", [](const ContactManifold& self) {
    return "ContactManifold(deepest=" + py::repr(py::cast(self.deepest)).cast<std::string>() + ", of " +
           std::to_string(self.corner_count) + " corners)";
  });
  bind_value(type, &arguments_of, &make_manifold);
  m.def("find_contact_manifold", &find_contact_manifold, kFindManifoldDoc, py::arg("shape1"), py::arg("pose1"), py::arg("shape2"),
        py::arg("pose2"), py::arg("proximity"));
  m.def("find_plane_contact_manifold", &find_plane_contact_manifold, kFindPlaneDoc, py::arg("shape"), py::arg("pose"),
        py::arg("proximity"));
  m.def(
      "find_curvature",
      [](const Shape& shape, const Pose& pose, const Vector3& normal) {
        return find_curvature(shape, pose, require_direction({"normal"}, normal));
      },
      kCurvatureDoc, py::arg("shape"), py::arg("pose"), py::arg("normal"));
  m.def(
      "find_contact_curvature",
      [](const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Vector3& normal) {
        const Vector3 n = require_direction({"normal"}, normal);
        const ContactCurvature result =
            find_contact_curvature(find_curvature(shape1, pose1, n) + find_curvature(shape2, pose2, -n), n);
        return std::pair(result.smaller, result.larger);
      },
      kContactCurvatureDoc, py::arg("shape1"), py::arg("pose1"), py::arg("shape2"), py::arg("pose2"), py::arg("normal"));
}

}  // namespace supernormal::python
