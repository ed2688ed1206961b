// Times of impact of N pairs on all cores, and with triangles.
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "batch_arguments.hpp"
#include "bindings.hpp"
#include "columns.hpp"
#include "enums.hpp"
#include "parallel_for.hpp"
#include "supernormal/impact/mesh_time_of_impact.hpp"
#include "supernormal/python/interpreter_lock.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

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
        throw py::type_error(entry.text() + " is " + std::string(py::repr(item)) + ", but must be a Motion" +
                             (is_list ? "" : " or a sequence of Motion"));
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

/// What find_times_of_impact() returns.
struct Impacts {
  explicit Impacts(std::ptrdiff_t pairs) : count(pairs) {}

  void set(std::ptrdiff_t i, const Impact& found) {
    if (found.status == ImpactStatus::InvalidInput) throw std::invalid_argument(kNotFinite);
    status.set(i, static_cast<std::uint8_t>(found.status));
    time.set(i, found.time);
    apart_until.set(i, found.apart_until);
    gap.set(i, found.proximity.gap);
    normal.set(i, found.proximity.normal);
    contact.set(i, found.proximity.contact);
    evaluations.set(i, found.evaluations);
  }

  std::ptrdiff_t count;
  Column<std::uint8_t> status{count};
  Column<double> time{count}, apart_until{count}, gap{count};
  Column<double, 3> normal{count}, contact{count};
  Column<int> evaluations{count};
};

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
    out->set(i, find_time_of_impact(bodies1[i], moving1[i], bodies2[i], moving2[i], horizon, settings));
  });
  return out;
}

std::vector<MeshTriangle> surface_of(const Doubles& points, const py::object& numbers) {
  const auto triangles = py::array::ensure(numbers);
  if (!triangles) throw py::type_error("triangles is " + std::string(py::repr(numbers)) + ", but must be an array of integers");
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
  if (found.impact.status == ImpactStatus::InvalidInput) throw std::invalid_argument(kNotFinite);
  return {found.impact, found.triangle};
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

void bind_impacts(py::module_& m) {
  py::class_<Impacts> type(m, "Impacts", kImpactsDoc);
  type.def("__len__", [](const Impacts& self) { return self.count; });
  bind_columns(type, "pairs", &Impacts::status, &Impacts::time, &Impacts::apart_until, &Impacts::gap, &Impacts::normal,
               &Impacts::contact, &Impacts::evaluations);
  bind_column(type, "status", &Impacts::status, "(N,) of uint8; compare with members of ImpactStatus");
  bind_column(type, "time", &Impacts::time, "(N,), s; time of impact; the horizon if there is none; apart_until if not converged");
  bind_column(type, "apart_until", &Impacts::apart_until, "(N,), s; the bodies are apart before this time");
  bind_column(type, "gap", &Impacts::gap, "(N,), m; at `time`; a lower bound if apart");
  bind_column(type, "normal", &Impacts::normal, "(N, 3), unit, from body 1 to body 2; at `time`");
  bind_column(type, "contact", &Impacts::contact, "(N, 3), m; where a contact force acts; at `time`");
  bind_column(type, "evaluations", &Impacts::evaluations, "(N,) of int32; evaluations of the gap function");
  m.def("find_times_of_impact", &times_of_impact, kFindImpactsDoc, py::arg("shapes1"), py::arg("motions1"), py::arg("shapes2"),
        py::arg("motions2"), py::arg("horizon"), py::arg("settings") = Settings(), py::arg("threads") = 0);
  m.def("find_mesh_time_of_impact", &mesh_time_of_impact, kMeshImpactDoc, py::arg("shape"), py::arg("motion"), py::arg("points"),
        py::arg("triangles"), py::arg("mesh_motion"), py::arg("horizon"), py::arg("settings") = Settings());
}

}  // namespace supernormal::python
