// The time of impact of two moving bodies.
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "bindings.hpp"
#include "enums.hpp"
#include "parallel_for.hpp"
#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/python/interpreter_lock.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

Vector3 require_within(const char* name, const Vector3& vector) {
  for (const double coordinate : vector) {
    if (std::islessequal(std::abs(coordinate), kMaxMotion)) continue;
    throw std::invalid_argument(std::string(name) + " = " + vector_text(vector.data(), 3) +
                                " has a coordinate that is not within " + to_text(kMaxMotion));
  }
  return vector;
}

Motion make_motion(const Pose& pose, const Vector3& velocity, const Vector3& angular_velocity, const Vector3& centre) {
  require_within("position", pose.position);
  return {pose, require_within("velocity", velocity), require_within("angular_velocity", angular_velocity),
          require_within("centre", centre)};
}

Impact require_answer(const Impact& impact) {
  if (impact.status == ImpactStatus::InvalidInput) throw std::invalid_argument(kNotFinite);
  return impact;
}

Impact time_of_impact(const Shape& shape1, const Motion& motion1, const Shape& shape2, const Motion& motion2, double horizon,
                      const Settings& settings, const std::optional<Vector3>& first_normal) {
  const Vector3 first = first_normal ? require_direction({"first_normal"}, *first_normal) : Vector3::UnitX();
  const WithoutTheLock unlocked;
  return require_answer(find_time_of_impact(shape1, motion1, shape2, motion2, horizon, settings, first_normal ? &first : nullptr));
}

Impact plane_time_of_impact(const Shape& shape, const Motion& motion, const Vector3& plane_normal, double plane_offset,
                            double horizon, const Settings& settings) {
  const Vector3 normal = require_direction({"plane_normal"}, plane_normal);
  require_in("plane_offset", plane_offset, -kMaxMotion, kMaxMotion, "m");
  const WithoutTheLock unlocked;
  return require_answer(find_plane_time_of_impact(shape, motion, normal, plane_offset, horizon, settings));
}

constexpr const char* kMotionDoc = R"(The motion of a body with constant velocities.

pose: at time 0.
velocity: (3,), m/s, of the centre.
angular_velocity: (3,), rad/s, in the world frame.
centre: (3,), m, in the body's frame: the centre of rotation, such as the centre of mass.

Raises ValueError when a number exceeds 1e75 in magnitude.)";

constexpr const char* kImpactDoc = "The first impact of two moving bodies, or the proof that there is none.";

constexpr const char* kFindImpactDoc =
    R"(The first time in [0, horizon] at which two bodies in steady motion meet, to the tolerance.

No impact is missed, however fast the bodies rotate: it is proved that they are apart before. Bodies that touch at time 0 hit at 0,
unless they separate.

horizon: s, in [0, 1e30].
settings: tolerance, solver and max_evaluations are used.
first_normal: (3,), in the frame of body 1, any length but 0: the start of the first query.

Raises ValueError when an argument is out of range, when a body rotates by more than 1e75 rad, or when a shape returns a number
that is not finite.)";

constexpr const char* kPlaneImpactDoc =
    R"(find_time_of_impact() for a body and the half-space plane_normal . x <= plane_offset, which is at rest.

plane_normal: (3,), world frame, out of the half-space, any length but 0; it is normalised.
plane_offset: m.)";

void bind_motion(py::module_& m) {
  py::class_<Motion> type(m, "Motion", kMotionDoc);
  type.def(py::init(&make_motion), py::arg("pose") = Pose(), py::arg("velocity") = Vector3(Vector3::Zero()),
           py::arg("angular_velocity") = Vector3(Vector3::Zero()), py::arg("centre") = Vector3(Vector3::Zero()))
      .def_property_readonly(
          "pose", [](const Motion& self) { return self.pose; }, "Pose, at time 0")
      .def_property_readonly(
          "velocity", [](const Motion& self) { return self.velocity; }, "(3,), m/s; of the centre")
      .def_property_readonly(
          "angular_velocity", [](const Motion& self) { return self.angular_velocity; }, "(3,), rad/s")
      .def_property_readonly(
          "centre", [](const Motion& self) { return self.centre; }, "(3,), m, in the body's frame")
      .def(
          "pose_at", [](const Motion& self, double time) { return pose_at(self, time); }, "The pose at a time (s).",
          py::arg("time"));
  bind_value(
      type, {"pose", "velocity", "angular_velocity", "centre"},
      [](const Motion& self) {
        return py::make_tuple(self.pose, plain(self.velocity), plain(self.angular_velocity), plain(self.centre));
      },
      [](const py::tuple& of) {
        return Motion{of[0].cast<Pose>(), of[1].cast<Vector3>(), of[2].cast<Vector3>(), of[3].cast<Vector3>()};
      });
}

}  // namespace

void bind_impact(py::module_& m) {
  bind_motion(m);
  py::class_<Impact> type(m, "Impact", kImpactDoc);
  type.def_readonly("status", &Impact::status, "ImpactStatus")
      .def_readonly("time", &Impact::time, "s; time of impact; the horizon if there is none; apart_until if not converged")
      .def_readonly("apart_until", &Impact::apart_until, "s; the bodies are apart before this time, except for a touch at time 0")
      .def_property_readonly(
          "proximity", [](const Impact& self) { return self.proximity; }, "Proximity at `time`; if apart, it proves this")
      .def_readonly("evaluations", &Impact::evaluations, "evaluations of the gap function; with a plane, of the support function")
      .def_property_readonly("may_hit", &Impact::may_hit, "Whether there is an impact, or it cannot be excluded.")
      .def("__repr__", [](const Impact& self) {
        return "Impact(status=" + py::cast(self.status).attr("name").cast<std::string>() + ", time=" + to_text(self.time) +
               ", evaluations=" + std::to_string(self.evaluations) + ")";
      });
  bind_value(
      type,
      [](const Impact& self) { return py::make_tuple(self.status, self.time, self.apart_until, self.proximity, self.evaluations); },
      [](const py::tuple& of) {
        return Impact{of[0].cast<ImpactStatus>(), of[1].cast<double>(), of[2].cast<double>(), of[3].cast<Proximity>(),
                      of[4].cast<int>()};
      });
  m.def("find_time_of_impact", &time_of_impact, kFindImpactDoc, py::arg("shape1"), py::arg("motion1"), py::arg("shape2"),
        py::arg("motion2"), py::arg("horizon"), py::arg("settings") = Settings(), py::arg("first_normal") = py::none());
  m.def("find_plane_time_of_impact", &plane_time_of_impact, kPlaneImpactDoc, py::arg("shape"), py::arg("motion"),
        py::arg("plane_normal"), py::arg("plane_offset"), py::arg("horizon"), py::arg("settings") = Settings());
}

}  // namespace supernormal::python
