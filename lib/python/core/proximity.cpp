// Settings, and the proximity of two bodies, of N pairs on all cores, and of a body and a plane.
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "bindings.hpp"
#include "columns.hpp"
#include "enums.hpp"
#include "pairs.hpp"
#include "parallel_for.hpp"
#include "proximity/gap/usable_settings.hpp"
#include "recording_shape.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/python/interpreter_lock.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

std::string status_name(Status status) { return py::cast(status).attr("name").cast<std::string>(); }

Proximity require_answer(const Proximity& result) {
  if (result.status == Status::InvalidInput) throw std::invalid_argument(kNotFinite);
  return result;
}

Proximity proximity(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Settings& settings,
                    const std::optional<Vector3>& first_normal) {
  const Vector3 first = first_normal ? require_direction({"first_normal"}, *first_normal) : Vector3::UnitX();
  const WithoutTheLock unlocked;
  return require_answer(find_proximity(shape1, pose1, shape2, pose2, settings, first_normal ? &first : nullptr));
}

std::pair<Proximity, py::array_t<double>> proximity_path(const Shape& shape1, const Pose& pose1, const Shape& shape2,
                                                         const Pose& pose2, const Settings& settings,
                                                         const std::optional<Vector3>& first_normal) {
  std::vector<Vector3> normals;
  const Proximity result = proximity(RecordingShape(shape1, normals), pose1, shape2, pose2, settings, first_normal);
  for (Vector3& n : normals) n = pose1.rotation * n;
  return {result, rows_of(normals)};
}

Proximity plane_proximity(const Shape& shape, const Pose& pose, const Vector3& plane_normal, double plane_offset) {
  const Vector3 normal = require_direction({"plane_normal"}, plane_normal);
  if (!std::isfinite(plane_offset)) throw std::invalid_argument("plane_offset = " + to_text(plane_offset) + " m is not finite");
  return require_answer(find_plane_proximity(shape, pose, normal, plane_offset));
}

Settings make_settings(Solver solver, double tolerance, int max_evaluations, bool stop_when_apart, bool certify_depth) {
  return require_in_range({solver, tolerance, max_evaluations, stop_when_apart, certify_depth});
}

/// A setting that a program may change within its range.
template <typename Value>
void bind_setting(py::class_<Settings>& type, const char* name, Value Settings::*setting, const char* doc) {
  type.def_property(
      name, [setting](const Settings& self) { return self.*setting; },
      [setting](Settings& self, Value value) {
        Settings changed = self;
        changed.*setting = value;
        self = require_in_range(changed);
      },
      doc);
}

std::unique_ptr<Proximities> proximities(const py::object& shapes1, const py::object& poses1, const py::object& shapes2,
                                         const py::object& poses2, const Settings& settings,
                                         const std::optional<Doubles>& first_normals, int threads) {
  const Pairs pairs(shapes1, poses1, shapes2, poses2, first_normals);
  auto out = std::make_unique<Proximities>(pairs.count());
  const auto set = [&out](std::ptrdiff_t i, const Proximity& result) { out->set(i, require_answer(result)); };
  parallel_for_ranges(pairs.count(), threads, [&](std::ptrdiff_t& i, std::ptrdiff_t end) {
    std::array<Proximity, Pairs::kAtOnce> results;
    const auto many = [&](std::span<const ProximityQuery> queries, std::span<const std::ptrdiff_t> which) {
      find_proximities(queries, settings, {results.data(), queries.size()});
      for (std::size_t k = 0; k < queries.size(); ++k) set(which[k], results[k]);
    };
    pairs.for_batches(i, end, many,
                      [&](const ProximityQuery& query, std::ptrdiff_t k) { set(k, find_proximity(query, settings)); });
  });
  return out;
}

constexpr const char* kSettingsDoc =
    R"(The solver of a query, and when it stops. Raises ValueError when a setting is out of range, also when it is changed.

solver: the method.
tolerance: the largest error of the gap, relative to the smallest half-extent of the two bodies, in [1e-15, 1].
max_evaluations: of the gap function, in [1, 1000000].
stop_when_apart: stop with Status.APART at the first normal that proves separation.
certify_depth: search until the depth of overlapping bodies is proved minimal: Proximity.is_global.)";

constexpr const char* kProximityDoc = "The common normal of two bodies. Frame: world.";

constexpr const char* kFindDoc = R"(The gap, common normal and witness points of two bodies, apart or overlapping.

pose1, pose2: of the bodies in the world.
first_normal: (3,), in the frame of body 1, any length but 0: the start of the solver, such as the normal of a similar earlier
pose.

For bodies apart or touching, every start leads to the same result. For overlapping bodies the gap function may have several local
maxima. With a first normal the solver follows the maximum to which it leads. Without one it searches for the highest.

Raises ValueError for settings or a first normal out of range, and when a shape returns a number that is not finite.)";

constexpr const char* kPathDoc = R"(The same as find_proximity, and how the solver found it: (Proximity, normals).

For ellipsoids and superellipsoids find_proximity takes its first steps in vector lanes. This function takes the same steps one by one,
so the last digits and a few evaluations may differ.

normals: (N, 3), unit, world frame, from body 1 to body 2: where the solver evaluated the gap function, in order. Two balls have none.
A query with max_evaluations below N evaluates the first of them.

Raises what find_proximity raises.)";

constexpr const char* kPlaneDoc =
    R"(The proximity of a body and the half-space plane_normal . x <= plane_offset, in closed form.

plane_normal: (3,), world frame, out of the half-space, any length but 0; it is normalised.
plane_offset: m.

Raises ValueError when an argument is out of range.)";

constexpr const char* kProximitiesDoc =
    R"(The results of find_proximities(), as arrays with one entry for each of the N pairs. Frame: world.)";

constexpr const char* kFindProximitiesDoc =
    R"(find_proximity() of N pairs on all cores, without the interpreter's lock. The results are bit for bit the same.

shapes1, shapes2: one Shape for all pairs, or Shapes, or a sequence of N Shape.
poses1, poses2: one Pose for all pairs, or Poses.
first_normals: (N, 3) or (3,), in the frame of body 1, any length but 0; or None.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Raises the errors of find_proximity(), with the index of the pair. Raises ValueError when the arguments differ in length.)";

}  // namespace

void bind_settings(py::module_& m) {
  py::class_<Settings> type(m, "Settings", kSettingsDoc);
  type.def(py::init(&make_settings), py::kw_only(), py::arg("solver") = Solver::Hybrid, py::arg("tolerance") = Settings().tolerance,
           py::arg("max_evaluations") = Settings().max_evaluations, py::arg("stop_when_apart") = false,
           py::arg("certify_depth") = false)
      .def("__repr__", [](const Settings& self) {
        return "Settings(solver=" + py::repr(py::cast(self.solver)).cast<std::string>() + ", tolerance=" + to_text(self.tolerance) +
               ", max_evaluations=" + std::to_string(self.max_evaluations) +
               ", stop_when_apart=" + (self.stop_when_apart ? "True" : "False") +
               ", certify_depth=" + (self.certify_depth ? "True" : "False") + ")";
      });
  bind_setting(type, "solver", &Settings::solver, "Solver");
  bind_setting(type, "tolerance", &Settings::tolerance, "in [1e-15, 1]");
  bind_setting(type, "max_evaluations", &Settings::max_evaluations, "in [1, 1000000]");
  bind_setting(type, "stop_when_apart", &Settings::stop_when_apart, "bool");
  bind_setting(type, "certify_depth", &Settings::certify_depth, "bool");
  const auto arguments_of = [](const Settings& self) {
    return py::make_tuple(self.solver, self.tolerance, self.max_evaluations, self.stop_when_apart, self.certify_depth);
  };
  bind_equality(type, arguments_of);
  bind_copies(type, arguments_of, [](const py::tuple& of) {
    return make_settings(of[0].cast<Solver>(), of[1].cast<double>(), of[2].cast<int>(), of[3].cast<bool>(), of[4].cast<bool>());
  });
}

void bind_proximity(py::module_& m) {
  py::class_<Proximity> type(m, "Proximity", kProximityDoc);
  type.def("__repr__", [](const Proximity& self) {
    return "Proximity(gap=" + to_text(self.gap) + ", error=" + to_text(self.error) +
           ", normal=" + vector_text(self.normal.data(), 3) + ", status=" + status_name(self.status) +
           ", is_global=" + (self.is_global ? "True" : "False") + ")";
  });
  bind_record(type, Field{"gap", &Proximity::gap, "m; signed distance: minus the penetration depth if negative"},
              Field{"error", &Proximity::error,
                    "m; estimated difference from the local maximum of the gap function; an upper bound if is_global"},
              Field{"normal", &Proximity::normal, "(3,), unit, from body 1 to body 2"},
              Field{"point1", &Proximity::point1, "(3,), m; on the boundary of body 1"},
              Field{"point2", &Proximity::point2, "(3,), m; on the boundary of body 2"},
              Field{"contact", &Proximity::contact, "(3,), m; where a contact force acts"},
              Field{"evaluations", &Proximity::evaluations, "evaluations of the gap function"},
              Field{"status", &Proximity::status, "Status"},
              Field{"is_global", &Proximity::is_global, "Whether it is proved that no other normal has a larger gap."},
              Field{"global_error", &Proximity::global_error,
                    "m; proved: the global maximum of the gap function lies in [gap, gap + global_error]"});
  m.def("find_proximity", &proximity, kFindDoc, py::arg("shape1"), py::arg("pose1"), py::arg("shape2"), py::arg("pose2"),
        py::arg("settings") = Settings(), py::arg("first_normal") = py::none());
  m.def("find_proximity_path", &proximity_path, kPathDoc, py::arg("shape1"), py::arg("pose1"), py::arg("shape2"), py::arg("pose2"),
        py::arg("settings") = Settings(), py::arg("first_normal") = py::none());
  m.def("find_plane_proximity", &plane_proximity, kPlaneDoc, py::arg("shape"), py::arg("pose"), py::arg("plane_normal"),
        py::arg("plane_offset"));

  py::class_<Proximities> pairs(m, "Proximities", kProximitiesDoc);
  pairs.def("__getitem__", [](const Proximities& self, std::ptrdiff_t i) {
    return self[static_cast<std::ptrdiff_t>(require_index("proximities", i, static_cast<std::size_t>(self.count())))];
  });
  bind_iteration(pairs);
  Proximities::bind(pairs, "pairs");
  m.def("find_proximities", &proximities, kFindProximitiesDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"),
        py::arg("poses2"), py::arg("settings") = Settings(), py::arg("first_normals") = py::none(), py::arg("threads") = 0);
}

}  // namespace supernormal::python
