// Derivatives and clearances of N pairs on all cores.
#include "supernormal/proximity/derivatives.hpp"

#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "columns.hpp"
#include "pairs.hpp"
#include "parallel_for.hpp"
#include "supernormal/proximity/clearance.hpp"

namespace py = pybind11;

namespace supernormal::python {
namespace {

constexpr auto kParameters = static_cast<py::ssize_t>(ParameterGradient::kCapacity);

/// One Proximity for all pairs, or Proximities.
class ProximitiesArgument {
 public:
  ProximitiesArgument(const char* name, const py::object& argument, PairCount& count) {
    if (py::isinstance<Proximity>(argument)) {
      single_ = argument.cast<Proximity>();
      if (count.value() == 1) return;
      throw std::invalid_argument(std::string(name) + " is one Proximity for " + std::to_string(count.value()) +
                                  " pairs, but must be Proximities");
    }
    if (!py::isinstance<Proximities>(argument)) {
      refuse_type(name, argument, "a Proximity or Proximities");
    }
    owner_ = argument;
    many_ = &argument.cast<const Proximities&>();
    count.add(name, static_cast<std::size_t>(many_->count()));
  }

  Proximity operator[](std::ptrdiff_t i) const { return many_ != nullptr ? (*many_)[i] : single_; }

 private:
  Proximity single_;
  py::object owner_;
  const Proximities* many_ = nullptr;
};

constexpr const char* kStatusDoc = "(N,) of uint8; compare with members of DerivativeStatus";
constexpr const char* kEvaluationsDoc = "(N,) of int32; evaluations of the gap function";

Eigen::Matrix<double, kParameters, 1> values_of(const ParameterGradient& gradient) {
  Eigen::Matrix<double, kParameters, 1> values = Eigen::Matrix<double, kParameters, 1>::Zero();
  for (std::size_t k = 0; k < gradient.size(); ++k) values[static_cast<Eigen::Index>(k)] = gradient[k].value;
  return values;
}

using Found = ProximityDerivatives;
constexpr std::tuple kDerivativeFields{
    Field{"status", &Found::status, kStatusDoc},
    Field{"has_gap", &Found::has_gap, "(N,) of bool; whether gap_gradient is the gradient, or a subgradient"},
    Field{"has_normal", &Found::has_normal, "(N,) of bool; whether normal and gap_hessian are defined"},
    Field{"has_points", &Found::has_points, "(N,) of bool; whether point1 and point2 are defined"},
    Field{"gap_gradient", &Found::gap_gradient, "(N, 12), m/m and m/rad"},
    Field{"normal", &Found::normal, "(N, 3, 12), 1/m and 1/rad"},
    Field{"point1", &Found::point1, "(N, 3, 12), m/m and m/rad; the point of space, not of the material"},
    Field{"point2", &Found::point2, "(N, 3, 12), m/m and m/rad"},
    Field{"common_normal", &Found::common_normal, "(N, 3), unit; the normal of the answer, exact to rounding"},
    Field{"evaluations", &Found::evaluations, kEvaluationsDoc},
    Field{"gap_hessian", &Found::gap_hessian, "(N, 12, 12), m/(m m), m/(m rad), m/(rad rad); or None"},
    Field{
        "parameters1", [](const Found& found) { return values_of(found.parameters1); },
        "(N, 16), m/m for a length, m for an exponent or a taper: the derivatives of the gap by the parameters of shape 1, in the "
        "order of Shape.parameter_names, then zeros; or None"},
    Field{"parameters2", [](const Found& found) { return values_of(found.parameters2); }, "The same of shape 2."}};

/// What find_proximity_derivatives() returns.
using Derivatives = Table<Found, kDerivativeFields>;

std::unique_ptr<Derivatives> derivatives_for(std::ptrdiff_t pairs, const DerivativeSettings& asked) {
  std::vector<std::string_view> left_out;
  if (!asked.hessian) left_out.push_back("gap_hessian");
  if (!asked.parameters) left_out.insert(left_out.end(), {"parameters1", "parameters2"});
  return std::make_unique<Derivatives>(pairs, left_out);
}

template <typename Answer>
const Answer& require_finite(const Answer& found) {
  if (found.status == DerivativeStatus::InvalidInput) throw std::invalid_argument(kNotFinite);
  return found;
}

/// Answers of N queries, with their bodies and poses.
class AnsweredPairs {
 public:
  AnsweredPairs(const py::object& shapes1, const py::object& poses1, const py::object& shapes2, const py::object& poses2,
                const py::object& proximities)
      : pairs_(shapes1, poses1, shapes2, poses2), answers_("proximities", proximities, pairs_.counted()) {}

  std::ptrdiff_t count() const { return pairs_.count(); }

  /// Calls find(shape1, pose1, shape2, pose2, proximity) for all pairs, and out.set(i, result).
  template <typename Find, typename Out>
  void find_all(int threads, Out& out, Find find) const {
    parallel_for(count(), threads, [&](std::ptrdiff_t i) {
      Vector3 none;
      const ProximityQuery query = pairs_.query(i, none);
      out.set(i, require_finite(find(*query.shape1, *query.pose1, *query.shape2, *query.pose2, answers_[i])));
    });
  }

 private:
  Pairs pairs_;
  ProximitiesArgument answers_;
};

std::unique_ptr<Derivatives> proximity_derivatives(const py::object& shapes1, const py::object& poses1, const py::object& shapes2,
                                                   const py::object& poses2, const py::object& proximities, bool hessian,
                                                   bool parameters, int threads) {
  const AnsweredPairs pairs(shapes1, poses1, shapes2, poses2, proximities);
  const DerivativeSettings settings{hessian, parameters};
  auto out = derivatives_for(pairs.count(), settings);
  pairs.find_all(threads, *out, [&](const auto&... pair) { return find_proximity_derivatives(pair..., settings); });
  return out;
}

std::unique_ptr<Derivatives> plane_derivatives(const py::object& shapes, const py::object& poses, const Doubles& plane_normal,
                                               const Doubles& plane_offset, bool hessian, bool parameters, int threads) {
  PairCount count;
  const ShapesArgument bodies("shapes", shapes, count);
  const PosesArgument places("poses", poses, count);
  const VectorsArgument normals("plane_normal", plane_normal, count);
  const NumbersArgument offsets("plane_offset", plane_offset, count);
  offsets.require_finite("m");
  const DerivativeSettings settings{hessian, parameters};
  auto out = derivatives_for(count.value(), settings);
  parallel_for(count.value(), threads, [&](std::ptrdiff_t i) {
    const Vector3 normal = require_direction(normals.name(i), normals[i]);
    out->set(i, require_finite(find_plane_derivatives(bodies[i], places[i], normal, offsets[i], settings)));
  });
  return out;
}

/// What find_gap_gradient() returns.
constexpr std::tuple kGradientFields{
    Field{"status", &GapGradient::status, kStatusDoc},
    Field{"has_gap", &GapGradient::has_gap, "(N,) of bool; whether it is the gradient, or a subgradient"},
    Field{"gradient", &GapGradient::gradient, "(N, 12), m/m and m/rad, by (v1, w1, v2, w2)"},
    Field{"evaluations", &GapGradient::evaluations, kEvaluationsDoc}};
using GapGradients = Table<GapGradient, kGradientFields>;

std::unique_ptr<GapGradients> gap_gradient(const py::object& shapes1, const py::object& poses1, const py::object& shapes2,
                                           const py::object& poses2, const py::object& proximities, int threads) {
  const AnsweredPairs pairs(shapes1, poses1, shapes2, poses2, proximities);
  auto out = std::make_unique<GapGradients>(pairs.count());
  pairs.find_all(threads, *out, [](const auto&... pair) { return find_gap_gradient(pair...); });
  return out;
}

constexpr std::tuple kClearanceFields{
    Field{"lower_bound", &Clearance::lower_bound, "(N,), m; the gap is at least this"},
    Field{"normal", &Clearance::normal, "(N, 3), unit, in the frame of body 1; it gives the bound"},
    Field{"evaluations", &Clearance::evaluations, kEvaluationsDoc}};
using Clearances = Table<Clearance, kClearanceFields>;

std::unique_ptr<Clearances> clearances(const py::object& shapes1, const py::object& poses1, const py::object& shapes2,
                                       const py::object& poses2, double enough, int max_evaluations,
                                       const std::optional<Doubles>& first_normals, int threads) {
  const Pairs pairs(shapes1, poses1, shapes2, poses2, first_normals);
  if (std::isnan(enough)) throw std::invalid_argument("enough = nan m, but must be a number");
  require_in("max_evaluations", max_evaluations, 1, 3);
  auto out = std::make_unique<Clearances>(pairs.count());
  parallel_for(pairs.count(), threads, [&](std::ptrdiff_t i) {
    Vector3 first;
    const ProximityQuery query = pairs.query(i, first);
    const Clearance found =
        find_clearance(*query.shape1, *query.pose1, *query.shape2, *query.pose2, enough, max_evaluations, query.first_normal);
    if (!std::isfinite(found.lower_bound)) throw std::invalid_argument(kNotFinite);
    out->set(i, found);
  });
  return out;
}

py::array_t<bool> farther(const py::object& shapes1, const py::object& poses1, const py::object& shapes2, const py::object& poses2,
                          const Doubles& distance, const std::optional<Doubles>& first_normals, int threads) {
  Pairs pairs(shapes1, poses1, shapes2, poses2, first_normals);
  const NumbersArgument distances("distance", distance, pairs.counted());
  distances.require_finite("m");
  Column<bool> out(pairs.count());
  parallel_for_ranges(pairs.count(), threads, [&](std::ptrdiff_t& i, std::ptrdiff_t end) {
    std::array<Clearance, Pairs::kAtOnce> bounds;
    std::array<bool, Pairs::kAtOnce> answers{};
    const auto many = [&](std::span<const ProximityQuery> queries, std::span<const std::ptrdiff_t> which) {
      for (std::size_t first = 0, last = 0; first < queries.size(); first = last) {
        const double asked = distances[which[first]];
        while (last < queries.size() && distances[which[last]] == asked) ++last;
        const std::size_t size = last - first;  // of pairs with the same distance
        are_farther_than(queries.subspan(first, size), asked, {bounds.data(), size}, {answers.data(), size});
        for (std::size_t k = 0; k < size; ++k) out.set(which[first + k], answers[k]);
      }
    };
    pairs.for_batches(i, end, many, [&](const ProximityQuery& query, std::ptrdiff_t k) {
      Vector3 first = query.first_normal != nullptr ? *query.first_normal : Vector3(Vector3::Zero());
      out.set(k, is_farther_than(*query.shape1, *query.pose1, *query.shape2, *query.pose2, distances[k], &first));
    });
  });
  return out.array();
}

constexpr const char* kDerivativesDoc =
    R"(Derivatives of the gaps, normals and witness points of N pairs: the results of find_proximity_derivatives(). Frame: world.

The last axis of 12 has the components of both bodies' twists, (v1, w1, v2, w2). A twist moves the origin of the body's frame by v
(m) and rotates the body about this origin by w (rad). What is not defined is 0, and nothing is NaN.)";

constexpr const char* kFindDerivativesDoc =
    R"(The derivatives of N answers of find_proximity() or find_proximities(), in closed form, on all cores.

shapes1, shapes2: one Shape for all pairs, or Shapes, or a sequence of N Shape.
poses1, poses2: one Pose for all pairs, or Poses.
proximities: the answer for the same shapes and poses: Proximity or Proximities.
hessian: whether to compute gap_hessian.
parameters: whether to compute parameters1 and parameters2.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Newton's method brings each normal to rounding first. Raises ValueError when a shape returns a number that is not finite, with the index of
the pair, and when the arguments differ in length.)";

constexpr const char* kPlaneDerivativesDoc =
    R"(The derivatives of find_plane_proximity() of N bodies and planes, in closed form, on all cores.

Body 2 is the half-space, and the origin of its frame is that of the world: its twist moves the plane by v2 and rotates it about this
origin by w2.

shapes: one Shape for all, or Shapes, or a sequence of N Shape.
poses: one Pose for all, or Poses.
plane_normal: (3,) or (N, 3), world frame, out of the half-space, any length but 0; it is normalised.
plane_offset: m; one for all or (N,).
hessian, parameters: whether to compute gap_hessian; parameters1 and parameters2.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Raises ValueError when an argument is out of range, when the arguments differ in length, and when a shape returns a number that is
not finite, with the index of the body.)";

constexpr const char* kGradientsDoc = "Gradients of the gaps of N pairs: the results of find_gap_gradient().";

constexpr const char* kGradientDoc =
    R"(The gradients of the gap of N answers, on all cores: ProximityDerivatives.gap_gradient, digit by digit.

shapes1, shapes2: one Shape for all pairs, or Shapes, or a sequence of N Shape.
poses1, poses2: one Pose for all pairs, or Poses.
proximities: the answer for the same shapes and poses: Proximity or Proximities.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Newton's method brings each normal to rounding first, with about two evaluations. Raises ValueError when a shape returns a number that is
not finite, with the index of the pair, and when the arguments differ in length.)";

constexpr const char* kClearancesDoc = "Proved lower bounds of the gaps of N pairs: the results of find_clearances().";

constexpr const char* kFindClearancesDoc =
    R"(Lower bounds of the gaps of N pairs, from at most max_evaluations evaluations each, on all cores.

shapes1, shapes2: one Shape for all pairs, or Shapes, or a sequence of N Shape.
poses1, poses2: one Pose for all pairs, or Poses.
enough: m; a search ends at the first normal whose bound is above it.
max_evaluations: in [1, 3].
first_normals: (N, 3) or (3,), in the frame of body 1, any length but 0; or None.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

Raises ValueError when an argument is out of range, when the arguments differ in length, and when a shape returns a number that is
not finite, with the index of the pair.)";

constexpr const char* kFartherDoc = R"(Whether the gaps of N pairs are larger than a distance: (N,) of bool, on all cores.

It takes one evaluation as a rule. True is proved. False is exact but for the tolerance 1e-9 of find_proximity(). For a negative
distance (the depth of an overlap), False means that no proof was found.

shapes1, shapes2: one Shape for all pairs, or Shapes, or a sequence of N Shape.
poses1, poses2: one Pose for all pairs, or Poses.
distance: m, finite; one for all pairs or (N,).
first_normals: (N, 3) or (3,), in the frame of body 1, any length but 0; or None. Clearances.normal is such.
threads: in [0, 256]; 0: up to one for each core, each with at least 256 of the N.

A shape that returns a number that is not finite is not farther. Raises ValueError when an argument is out of range, and when the
arguments differ in length.)";

}  // namespace

void bind_derivatives(py::module_& m) {
  py::class_<Derivatives> derivatives(m, "ProximityDerivatives", kDerivativesDoc);
  Derivatives::bind(derivatives, "pairs");
  py::class_<GapGradients> gradients(m, "GapGradients", kGradientsDoc);
  GapGradients::bind(gradients, "pairs");
  m.def("find_proximity_derivatives", &proximity_derivatives, kFindDerivativesDoc, py::arg("shapes1"), py::arg("poses1"),
        py::arg("shapes2"), py::arg("poses2"), py::arg("proximities"), py::arg("hessian") = true, py::arg("parameters") = true,
        py::arg("threads") = 0);
  m.def("find_plane_derivatives", &plane_derivatives, kPlaneDerivativesDoc, py::arg("shapes"), py::arg("poses"),
        py::arg("plane_normal"), py::arg("plane_offset"), py::arg("hessian") = true, py::arg("parameters") = true,
        py::arg("threads") = 0);
  m.def("find_gap_gradient", &gap_gradient, kGradientDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"),
        py::arg("poses2"), py::arg("proximities"), py::arg("threads") = 0);

  py::class_<Clearances> bounds(m, "Clearances", kClearancesDoc);
  Clearances::bind(bounds, "pairs");
  m.def("find_clearances", &clearances, kFindClearancesDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"),
        py::arg("poses2"), py::arg("enough") = std::numeric_limits<double>::infinity(), py::arg("max_evaluations") = 3,
        py::arg("first_normals") = py::none(), py::arg("threads") = 0);
  m.def("are_farther_than", &farther, kFartherDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"), py::arg("poses2"),
        py::arg("distance"), py::arg("first_normals") = py::none(), py::arg("threads") = 0);
}

}  // namespace supernormal::python
