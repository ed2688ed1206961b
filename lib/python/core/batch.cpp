// Queries of N pairs and N rays on all cores.
#include "supernormal/proximity/batch.hpp"

#include <pybind11/stl.h>

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "columns.hpp"
#include "enums.hpp"
#include "pairs.hpp"
#include "parallel_for.hpp"
#include "supernormal/proximity/solve.hpp"
#include "supernormal/raycast/ray.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

std::unique_ptr<Proximities> proximities(const py::object& shapes1, const py::object& poses1, const py::object& shapes2,
                                         const py::object& poses2, const Settings& settings,
                                         const std::optional<Doubles>& first_normals, int threads) {
  const Pairs pairs(shapes1, poses1, shapes2, poses2, first_normals);
  auto out = std::make_unique<Proximities>(pairs.count());
  const auto set = [&out](std::ptrdiff_t i, const Proximity& result) {
    if (result.status == Status::InvalidInput) throw std::invalid_argument(kNotFinite);
    out->set(i, result);
  };
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

constexpr const char* kProximitiesDoc =
    R"(The results of find_proximities(), as arrays with one entry for each of the N pairs. Frame: world.)";

constexpr const char* kFindProximitiesDoc =
    R"(find_proximity() of N pairs on all cores, without the interpreter's lock. The results are bit for bit the same.

shapes1, shapes2: one Shape for all pairs, or Shapes, or a sequence of N Shape.
poses1, poses2: one Pose for all pairs, or Poses.
first_normals: (N, 3) or (3,), in the frame of body 1, any length but 0; or None.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Raises the errors of find_proximity(), with the index of the pair. Raises ValueError when the arguments differ in length.)";

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

void bind_batch(py::module_& m) {
  py::class_<Proximities> pairs(m, "Proximities", kProximitiesDoc);
  pairs.def("__getitem__", [](const Proximities& self, std::ptrdiff_t i) {
    return self[static_cast<std::ptrdiff_t>(require_index("proximities", i, static_cast<std::size_t>(self.count())))];
  });
  bind_iteration(pairs);
  Proximities::bind(pairs, "pairs");
  m.def("find_proximities", &proximities, kFindProximitiesDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"),
        py::arg("poses2"), py::arg("settings") = Settings(), py::arg("first_normals") = py::none(), py::arg("threads") = 0);

  py::class_<RayHits> rays(m, "RayHits", kRayHitsDoc);
  RayHits::bind(rays, "rays");
  m.def("find_ray_hits", &ray_hits, kFindRayHitsDoc, py::arg("shapes"), py::arg("poses"), py::arg("origins"), py::arg("directions"),
        py::arg("length") = std::numeric_limits<double>::infinity(), py::arg("settings") = Settings(), py::arg("threads") = 0);
}

}  // namespace supernormal::python
