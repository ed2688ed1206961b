// The first hit of a ray on a body.

#include <limits>
#include <stdexcept>

#include "arrays.hpp"
#include "base/validation.hpp"
#include "bindings.hpp"
#include "enums.hpp"
#include "parallel_for.hpp"
#include "supernormal/python/interpreter_lock.hpp"
#include "supernormal/raycast/ray.hpp"
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

constexpr const char* kHitDoc = "The point where a ray meets the boundary of a body. Frame: world.";

constexpr const char* kRayDoc =
    R"(The first point of the boundary on a ray: where it enters the body or, from inside, where it leaves the body.

origin: (3,), m, within 1e150.
direction: (3,), any length but 0; it is normalised.
length: m, in [0, inf].
settings: tolerance (of boundary_error, relative to the smallest half-extent) and max_evaluations are used.

Raises ValueError when an argument is out of range, or when the shape returns a number that is not finite.)";

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
}

}  // namespace supernormal::python
