// The first hit of a ray on a body, and of N rays on all cores.
#include <pybind11/stl.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <type_traits>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "bindings.hpp"
#include "columns.hpp"
#include "enums.hpp"
#include "pairs.hpp"
#include "parallel_for.hpp"
#include "supernormal/python/interpreter_lock.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/sphere.hpp"
#include "values.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

RayHit ray_hit(const Shape& shape, const Pose& pose, const Vector3& origin, const Vector3& direction, double length,
               const Settings& settings) {
  require_place({"origin"}, origin);
  const Vector3 along = require_direction({"direction"}, direction);
  const WithoutTheLock unlocked;
  const RayHit result = find_ray_hit(shape, pose, origin, along, length, settings);
  if (result.status == Status::InvalidInput) throw std::invalid_argument(kNotFinite);
  return result;
}

/// What a hit has, NaN without one.
template <typename Value>
Value if_hit(const RayHit& result, const Value& value) {
  if constexpr (std::is_same_v<Value, Vector3>) {
    return result.hit ? value : Vector3(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
  } else {
    return result.hit ? value : std::numeric_limits<double>::quiet_NaN();
  }
}

constexpr std::tuple kRayHitFields{
    Field{"hit", &RayHit::hit, "(N,) of bool; whether the ray meets the boundary within its length"},
    Field{"from_inside", &RayHit::from_inside, "(N,) of bool; whether the origin is inside"},
    Field{"distance", [](const RayHit& self) { return if_hit(self, self.distance); }, "(N,), m; along the ray"},
    Field{"point", [](const RayHit& self) { return if_hit(self, self.point); }, "(N, 3), m"},
    Field{"normal", [](const RayHit& self) { return if_hit(self, self.normal); }, "(N, 3), unit, outward"},
    Field{"status", &RayHit::status, "(N,) of uint8; compare with members of Status"}};
using RayHits = Table<RayHit, kRayHitFields>;

std::unique_ptr<RayHits> ray_hits(const py::object& shapes, const py::object& poses, const Doubles& origins,
                                  const Doubles& directions, double length, const Settings& settings, int threads) {
  PairCount count;
  const ShapesArgument bodies("shapes", shapes, count);
  const PosesArgument places("poses", poses, count);
  const VectorsArgument from("origins", origins, count), along("directions", directions, count);
  find_ray_hit(Sphere(1), {}, Vector3::Zero(), Vector3::UnitX(), length, settings);  // refuses what is no ray's fault
  auto out = std::make_unique<RayHits>(count.value());
  parallel_for(count.value(), threads, [&](std::ptrdiff_t i) {
    const Vector3 origin = require_place(from.name(i), from[i]), direction = require_direction(along.name(i), along[i]);
    const RayHit result = find_ray_hit(bodies[i], places[i], origin, direction, length, settings);
    if (result.status == Status::InvalidInput) throw std::invalid_argument(kNotFinite);
    out->set(i, result);
  });
  return out;
}

constexpr const char* kHitDoc = "The point where a ray meets the boundary of a body. Frame: world.";

constexpr const char* kRayDoc =
    R"(The first point of the boundary on a ray: where it enters the body or, from inside, where it leaves the body.

origin: (3,), m, within 1e150.
direction: (3,), any length but 0; it is normalised.
length: m, in [0, inf].
settings: tolerance (of boundary_error, relative to the smallest half-extent) and max_evaluations are used.

Raises ValueError when an argument is out of range, or when the shape returns a number that is not finite.)";

constexpr const char* kRayHitsDoc =
    R"(The results of find_ray_hits(), as arrays with one entry for each of the N rays. Frame: world.

Numbers are NaN for rays without a hit.)";

constexpr const char* kFindRayHitsDoc =
    R"(find_ray_hit() of N rays on all cores, without the interpreter's lock. The results are bit for bit the same.

shapes: one Shape for all rays, or Shapes, or a sequence of N Shape.
poses: one Pose for all rays, or Poses.
origins: (N, 3) or (3,), m.
directions: (N, 3) or (3,), any length but 0.
length: m, of all rays, in [0, inf].
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Raises the errors of find_ray_hit(), with the index of the ray. Raises ValueError when the arguments differ in length.)";

}  // namespace

void bind_raycast(py::module_& m) {
  py::class_<RayHit> type(m, "RayHit", kHitDoc);
  type.def("__repr__", [](const RayHit& self) {
    if (!self.hit) return std::string("RayHit(hit=False)");
    return "RayHit(hit=True, distance=" + to_text(self.distance) + ", point=" + vector_text(self.point.data(), 3) +
           ", normal=" + vector_text(self.normal.data(), 3) + ")";
  });
  bind_record(type, Field{"hit", &RayHit::hit, "Whether the ray meets the boundary within its length."},
              Field{"from_inside", &RayHit::from_inside, "Whether the origin is inside. The hit is then where the ray leaves."},
              Field{"distance", &RayHit::distance, "m; along the ray"},
              Field{"distance_error", &RayHit::distance_error, "m; estimate"},
              Field{"boundary_error", &RayHit::boundary_error, "m; upper bound of the distance of `point` from the boundary"},
              Field{"point", &RayHit::point, "(3,), m"}, Field{"normal", &RayHit::normal, "(3,), unit, outward, also from inside"},
              Field{"evaluations", &RayHit::evaluations, "evaluations of the support function"},
              Field{"status", &RayHit::status, "Status; unless CONVERGED, `hit` is preliminary"});
  m.def("find_ray_hit", &ray_hit, kRayDoc, py::arg("shape"), py::arg("pose"), py::arg("origin"), py::arg("direction"),
        py::arg("length") = std::numeric_limits<double>::infinity(), py::arg("settings") = Settings());

  py::class_<RayHits> rays(m, "RayHits", kRayHitsDoc);
  RayHits::bind(rays, "rays");
  m.def("find_ray_hits", &ray_hits, kFindRayHitsDoc, py::arg("shapes"), py::arg("poses"), py::arg("origins"), py::arg("directions"),
        py::arg("length") = std::numeric_limits<double>::infinity(), py::arg("settings") = Settings(), py::arg("threads") = 0);
}

}  // namespace supernormal::python
