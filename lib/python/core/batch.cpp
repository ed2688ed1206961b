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

struct RayHits {
  explicit RayHits(std::ptrdiff_t rays) : count(rays) {}

  void set(std::ptrdiff_t i, const RayHit& result) {
    hit.set(i, result.hit);
    from_inside.set(i, result.from_inside);
    distance.set(i, result.hit ? result.distance : std::numeric_limits<double>::quiet_NaN());
    point.set(i, result.hit ? result.point : Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
    normal.set(i, result.hit ? result.normal : Vector3::Constant(std::numeric_limits<double>::quiet_NaN()));
    status.set(i, static_cast<std::uint8_t>(result.status));
  }

  std::ptrdiff_t count;
  Column<bool> hit{count}, from_inside{count};
  Column<double> distance{count};
  Column<double, 3> point{count}, normal{count};
  Column<std::uint8_t> status{count};
};

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
  pairs.def("__len__", [](const Proximities& self) { return self.count; })
      .def("__getitem__", [](const Proximities& self, std::ptrdiff_t i) {
        return self[static_cast<std::ptrdiff_t>(require_index("proximities", i, static_cast<std::size_t>(self.count)))];
      });
  bind_iteration(pairs);
  bind_columns(pairs, "pairs", &Proximities::gap, &Proximities::error, &Proximities::normal, &Proximities::point1,
               &Proximities::point2, &Proximities::contact, &Proximities::evaluations, &Proximities::status,
               &Proximities::is_global, &Proximities::global_error);
  bind_column(pairs, "gap", &Proximities::gap, "(N,), m; signed distance: minus the penetration depth if negative");
  bind_column(pairs, "error", &Proximities::error, "(N,), m; estimated error of the gap; an upper bound if is_global");
  bind_column(pairs, "normal", &Proximities::normal, "(N, 3), unit, from body 1 to body 2");
  bind_column(pairs, "point1", &Proximities::point1, "(N, 3), m; on the boundary of body 1");
  bind_column(pairs, "point2", &Proximities::point2, "(N, 3), m; on the boundary of body 2");
  bind_column(pairs, "contact", &Proximities::contact, "(N, 3), m; where a contact force acts");
  bind_column(pairs, "evaluations", &Proximities::evaluations, "(N,) of int32; evaluations of the gap function");
  bind_column(pairs, "status", &Proximities::status, "(N,) of uint8; compare with members of Status");
  bind_column(pairs, "is_global", &Proximities::is_global, "(N,) of bool; whether the gap is the proved global maximum");
  bind_column(pairs, "global_error", &Proximities::global_error, "(N,), m; proved upper bound of the global maximum minus the gap");
  m.def("find_proximities", &proximities, kFindProximitiesDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"),
        py::arg("poses2"), py::arg("settings") = Settings(), py::arg("first_normals") = py::none(), py::arg("threads") = 0);

  py::class_<RayHits> rays(m, "RayHits", kRayHitsDoc);
  rays.def("__len__", [](const RayHits& self) { return self.count; });
  bind_columns(rays, "rays", &RayHits::hit, &RayHits::from_inside, &RayHits::distance, &RayHits::point, &RayHits::normal,
               &RayHits::status);
  bind_column(rays, "hit", &RayHits::hit, "(N,) of bool; whether the ray meets the boundary within its length");
  bind_column(rays, "from_inside", &RayHits::from_inside, "(N,) of bool; whether the origin is inside");
  bind_column(rays, "distance", &RayHits::distance, "(N,), m; along the ray");
  bind_column(rays, "point", &RayHits::point, "(N, 3), m");
  bind_column(rays, "normal", &RayHits::normal, "(N, 3), unit, outward");
  bind_column(rays, "status", &RayHits::status, "(N,) of uint8; compare with members of Status");
  m.def("find_ray_hits", &ray_hits, kFindRayHitsDoc, py::arg("shapes"), py::arg("poses"), py::arg("origins"), py::arg("directions"),
        py::arg("length") = std::numeric_limits<double>::infinity(), py::arg("settings") = Settings(), py::arg("threads") = 0);
}

}  // namespace supernormal::python
