// The time of impact of two moving bodies, of N pairs on all cores, and of a body and triangles.
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "bindings.hpp"
#include "columns.hpp"
#include "enums.hpp"
#include "pairs.hpp"
#include "parallel_for.hpp"
#include "supernormal/impact/mesh_time_of_impact.hpp"
#include "supernormal/impact/time_of_impact.hpp"
#include "supernormal/python/interpreter_lock.hpp"
#include "supernormal/shapes/sphere.hpp"
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
      .def(
          "pose_at", [](const Motion& self, double time) { return pose_at(self, time); }, "The pose at a time (s).",
          py::arg("time"));
  bind_arguments(type, maker<decltype(type), Pose, Vector3, Vector3, Vector3>(), Field{"pose", &Motion::pose, "Pose, at time 0"},
                 Field{"velocity", &Motion::velocity, "(3,), m/s; of the centre"},
                 Field{"angular_velocity", &Motion::angular_velocity, "(3,), rad/s"},
                 Field{"centre", &Motion::centre, "(3,), m, in the body's frame"});
}

/// One Motion for all pairs, or a sequence of Motion.
class MotionsArgument {
 public:
  MotionsArgument(const char* name, const py::object& argument, PairCount& count) : is_single_(py::isinstance<Motion>(argument)) {
    if (is_single_) {
      motions_ = {argument.cast<Motion>()};
      return;
    }
    const bool is_list = py::isinstance<py::sequence>(argument);
    for (const py::handle item : is_list ? py::sequence(argument) : py::sequence(py::make_tuple(argument))) {
      if (!py::isinstance<Motion>(item)) {
        const Name entry{name, is_list ? static_cast<std::ptrdiff_t>(motions_.size()) : -1};
        refuse_type(entry.text(), item, is_list ? "a Motion" : "a Motion or a sequence of Motion");
      }
      motions_.push_back(item.cast<Motion>());
    }
    count.add(name, motions_.size());
  }

  const Motion& operator[](std::ptrdiff_t i) const { return motions_[is_single_ ? 0 : static_cast<std::size_t>(i)]; }

 private:
  bool is_single_;
  std::vector<Motion> motions_;
};

constexpr std::tuple kImpactFields{
    Field{"status", &Impact::status, "(N,) of uint8; compare with members of ImpactStatus"},
    Field{"time", &Impact::time, "(N,), s; time of impact; the horizon if there is none; apart_until if not converged"},
    Field{"apart_until", &Impact::apart_until, "(N,), s; the bodies are apart before this time"},
    Field{"gap", [](const Impact& self) { return self.proximity.gap; }, "(N,), m; at `time`; a lower bound if apart"},
    Field{"normal", [](const Impact& self) { return self.proximity.normal; }, "(N, 3), unit, from body 1 to body 2; at `time`"},
    Field{"contact", [](const Impact& self) { return self.proximity.contact; }, "(N, 3), m; where a contact force acts; at `time`"},
    Field{"evaluations", &Impact::evaluations, "(N,) of int32; evaluations of the gap function"}};
using Impacts = Table<Impact, kImpactFields>;

std::unique_ptr<Impacts> times_of_impact(const py::object& shapes1, const py::object& motions1, const py::object& shapes2,
                                         const py::object& motions2, double horizon, const Settings& settings, int threads) {
  PairCount count;
  const ShapesArgument bodies1("shapes1", shapes1, count);
  const MotionsArgument moving1("motions1", motions1, count);
  const ShapesArgument bodies2("shapes2", shapes2, count);
  const MotionsArgument moving2("motions2", motions2, count);
  find_plane_time_of_impact(Sphere(1), {}, Vector3::UnitZ(), -2, horizon, settings);  // refuses what is no pair's fault
  auto out = std::make_unique<Impacts>(count.value());
  parallel_for(count.value(), threads, [&](std::ptrdiff_t i) {
    out->set(i, require_answer(find_time_of_impact(bodies1[i], moving1[i], bodies2[i], moving2[i], horizon, settings)));
  });
  return out;
}

std::vector<MeshTriangle> surface_of(const Doubles& points, const py::object& numbers) {
  const auto triangles = py::array::ensure(numbers);
  if (!triangles) refuse_type("triangles", numbers, "an array of integers");
  const py::ssize_t count = require_rows("points", points, {3});
  const py::ssize_t faces = require_rows("triangles", triangles, {3});
  if (std::string("iu").find(triangles.dtype().kind()) == std::string::npos) {
    throw py::type_error("triangles has numbers of the type " + std::string(py::str(triangles.dtype())) + ", but must be integers");
  }
  const auto corners = triangles.cast<py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>>();
  std::vector<MeshTriangle> made(static_cast<std::size_t>(faces));
  for (py::ssize_t k = 0; k < 3 * faces; ++k) {
    const std::int64_t corner = corners.data()[k];
    const Name entry{"triangles", k / 3};
    if (corner < 0 || corner >= count) {
      throw std::invalid_argument(entry.text() + " has the corner " + std::to_string(corner) + ", but there are " +
                                  std::to_string(count) + " points");
    }
    MeshTriangle& triangle = made[static_cast<std::size_t>(k / 3)];
    triangle.vertices[static_cast<std::size_t>(k % 3)] = require_place({"points", corner}, vector_at(points.data() + 3 * corner));
    triangle.index = static_cast<int>(k / 3);
  }
  return made;
}

std::pair<Impact, int> mesh_time_of_impact(const Shape& shape, const Motion& motion, const Doubles& points,
                                           const py::object& numbers, const Motion& mesh_motion, double horizon,
                                           const Settings& settings) {
  const std::vector<MeshTriangle> surface = surface_of(points, numbers);
  const WithoutTheLock unlocked;
  const MeshImpact found = find_mesh_time_of_impact(shape, motion, surface, mesh_motion, horizon, settings);
  return {require_answer(found.impact), found.triangle};
}

constexpr const char* kImpactsDoc =
    "The results of find_times_of_impact(), as arrays with one entry for each of the N pairs. Frame: world.";

constexpr const char* kFindImpactsDoc =
    R"(find_time_of_impact() of N pairs on all cores, without the interpreter's lock. The results are bit for bit the same.

shapes1, shapes2: one Shape for all pairs, or Shapes, or a sequence of N Shape.
motions1, motions2: one Motion for all pairs, or a sequence of N Motion.
horizon: s, of all pairs, in [0, 1e30].
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Raises the errors of find_time_of_impact(), with the index of the pair. Raises ValueError when the arguments differ in length.)";

constexpr const char* kMeshImpactDoc =
    R"(find_time_of_impact() with a surface of triangles: (Impact, index of the triangle, or -1 without an impact).

points: (N, 3), m, in the frame of mesh_motion.
triangles: (M, 3) of integers: indices of points. Every triangle counts, from both sides, and nothing is solid behind it.
mesh_motion: the motion of the surface.

Raises what find_time_of_impact() raises, and ValueError for a corner without a point.)";

}  // namespace

void bind_impact(py::module_& m) {
  bind_motion(m);
  py::class_<Impact> type(m, "Impact", kImpactDoc);
  type.def_property_readonly("may_hit", &Impact::may_hit, "Whether there is an impact, or it cannot be excluded.")
      .def("__repr__", [](const Impact& self) {
        return "Impact(status=" + py::cast(self.status).attr("name").cast<std::string>() + ", time=" + to_text(self.time) +
               ", evaluations=" + std::to_string(self.evaluations) + ")";
      });
  bind_record(type, Field{"status", &Impact::status, "ImpactStatus"},
              Field{"time", &Impact::time, "s; time of impact; the horizon if there is none; apart_until if not converged"},
              Field{"apart_until", &Impact::apart_until, "s; the bodies are apart before this time, except for a touch at time 0"},
              Field{"proximity", &Impact::proximity, "Proximity at `time`; if apart, it proves this"},
              Field{"evaluations", &Impact::evaluations, "evaluations of the gap function; with a plane, of the support function"});
  m.def("find_time_of_impact", &time_of_impact, kFindImpactDoc, py::arg("shape1"), py::arg("motion1"), py::arg("shape2"),
        py::arg("motion2"), py::arg("horizon"), py::arg("settings") = Settings(), py::arg("first_normal") = py::none());
  m.def("find_plane_time_of_impact", &plane_time_of_impact, kPlaneImpactDoc, py::arg("shape"), py::arg("motion"),
        py::arg("plane_normal"), py::arg("plane_offset"), py::arg("horizon"), py::arg("settings") = Settings());
  py::class_<Impacts> many(m, "Impacts", kImpactsDoc);
  Impacts::bind(many, "pairs");
  m.def("find_times_of_impact", &times_of_impact, kFindImpactsDoc, py::arg("shapes1"), py::arg("motions1"), py::arg("shapes2"),
        py::arg("motions2"), py::arg("horizon"), py::arg("settings") = Settings(), py::arg("threads") = 0);
  m.def("find_mesh_time_of_impact", &mesh_time_of_impact, kMeshImpactDoc, py::arg("shape"), py::arg("motion"), py::arg("points"),
        py::arg("triangles"), py::arg("mesh_motion"), py::arg("horizon"), py::arg("settings") = Settings());
}

}  // namespace supernormal::python
