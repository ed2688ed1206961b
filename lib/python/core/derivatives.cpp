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
      throw py::type_error(std::string(name) + " is " + std::string(py::repr(argument)) +
                           ", but must be a Proximity or Proximities");
    }
    owner_ = argument;
    many_ = &argument.cast<const Proximities&>();
    count.add(name, static_cast<std::size_t>(many_->count));
  }

  Proximity operator[](std::ptrdiff_t i) const { return many_ != nullptr ? (*many_)[i] : single_; }

 private:
  Proximity single_;
  py::object owner_;
  const Proximities* many_ = nullptr;
};

/// What find_proximity_derivatives() returns. A column that was not asked for has no entries.
struct Derivatives {
  explicit Derivatives(std::ptrdiff_t pairs, const DerivativeSettings& asked = {})
      : settings(asked),
        count(pairs),
        gap_hessian(settings.hessian ? pairs : 0),
        parameters1(settings.parameters ? pairs : 0),
        parameters2(settings.parameters ? pairs : 0) {}

  void set(std::ptrdiff_t i, const ProximityDerivatives& found) {
    status.set(i, static_cast<std::uint8_t>(found.status));
    has_gap.set(i, found.has_gap);
    has_normal.set(i, found.has_normal);
    has_points.set(i, found.has_points);
    gap_gradient.set(i, found.gap_gradient);
    normal.set(i, found.normal);
    point1.set(i, found.point1);
    point2.set(i, found.point2);
    common_normal.set(i, found.common_normal);
    evaluations.set(i, found.evaluations);
    if (settings.hessian) gap_hessian.set(i, found.gap_hessian);
    if (!settings.parameters) return;
    parameters1.set(i, values_of(found.parameters1));
    parameters2.set(i, values_of(found.parameters2));
  }

  DerivativeSettings settings;
  std::ptrdiff_t count;
  Column<std::uint8_t> status{count};
  Column<bool> has_gap{count}, has_normal{count}, has_points{count};
  Column<double, 12> gap_gradient{count};
  Column<double, 3, 12> normal{count}, point1{count}, point2{count};
  Column<double, 3> common_normal{count};
  Column<int> evaluations{count};
  Column<double, 12, 12> gap_hessian;
  Column<double, kParameters> parameters1, parameters2;

 private:
  static Eigen::Matrix<double, kParameters, 1> values_of(const ParameterGradient& gradient) {
    Eigen::Matrix<double, kParameters, 1> values = Eigen::Matrix<double, kParameters, 1>::Zero();
    for (std::size_t k = 0; k < gradient.size(); ++k) values[static_cast<Eigen::Index>(k)] = gradient[k].value;
    return values;
  }
};

template <typename Found>
const Found& require_finite(const Found& found) {
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
  auto out = std::make_unique<Derivatives>(pairs.count(), settings);
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
  auto out = std::make_unique<Derivatives>(count.value(), settings);
  parallel_for(count.value(), threads, [&](std::ptrdiff_t i) {
    const Vector3 normal = require_direction(normals.name(i), normals[i]);
    out->set(i, require_finite(find_plane_derivatives(bodies[i], places[i], normal, offsets[i], settings)));
  });
  return out;
}

/// What find_gap_gradient() returns.
struct GapGradients {
  explicit GapGradients(std::ptrdiff_t pairs) : count(pairs) {}

  void set(std::ptrdiff_t i, const GapGradient& found) {
    status.set(i, static_cast<std::uint8_t>(found.status));
    has_gap.set(i, found.has_gap);
    gradient.set(i, found.gradient);
    evaluations.set(i, found.evaluations);
  }

  std::ptrdiff_t count;
  Column<std::uint8_t> status{count};
  Column<bool> has_gap{count};
  Column<double, 12> gradient{count};
  Column<int> evaluations{count};
};

std::unique_ptr<GapGradients> gap_gradient(const py::object& shapes1, const py::object& poses1, const py::object& shapes2,
                                           const py::object& poses2, const py::object& proximities, int threads) {
  const AnsweredPairs pairs(shapes1, poses1, shapes2, poses2, proximities);
  auto out = std::make_unique<GapGradients>(pairs.count());
  pairs.find_all(threads, *out, [](const auto&... pair) { return find_gap_gradient(pair...); });
  return out;
}

struct Clearances {
  explicit Clearances(std::ptrdiff_t pairs) : count(pairs) {}

  void set(std::ptrdiff_t i, const Clearance& found) {
    lower_bound.set(i, found.lower_bound);
    normal.set(i, found.normal);
    evaluations.set(i, found.evaluations);
  }

  std::ptrdiff_t count;
  Column<double> lower_bound{count};
  Column<double, 3> normal{count};
  Column<int> evaluations{count};
};

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

constexpr const char* kStatusDoc = "(N,) of uint8; compare with members of DerivativeStatus";
constexpr const char* kEvaluationsDoc = "(N,) of int32; evaluations of the gap function";

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

/// A column that may not have been asked for: None then.
template <typename ColumnType>
void bind_optional(py::class_<Derivatives>& type, const char* name, ColumnType Derivatives::*column, const char* doc) {
  type.def_property_readonly(
      name,
      [column](const Derivatives& self) -> std::optional<py::array_t<double>> {
        const auto& array = (self.*column).array();
        if (array.shape(0) != self.count) return std::nullopt;
        return array;
      },
      doc);
}

void bind_gradients_class(py::module_& m) {
  py::class_<GapGradients> type(m, "GapGradients", kGradientsDoc);
  type.def("__len__", [](const GapGradients& self) { return self.count; });
  bind_columns(type, "pairs", &GapGradients::status, &GapGradients::has_gap, &GapGradients::gradient, &GapGradients::evaluations);
  bind_column(type, "status", &GapGradients::status, kStatusDoc);
  bind_column(type, "has_gap", &GapGradients::has_gap, "(N,) of bool; whether it is the gradient, or a subgradient");
  bind_column(type, "gradient", &GapGradients::gradient, "(N, 12), m/m and m/rad, by (v1, w1, v2, w2)");
  bind_column(type, "evaluations", &GapGradients::evaluations, kEvaluationsDoc);
}

void bind_derivatives_class(py::module_& m) {
  py::class_<Derivatives> type(m, "ProximityDerivatives", kDerivativesDoc);
  type.def("__len__", [](const Derivatives& self) { return self.count; });
  bind_columns(type, "pairs", &Derivatives::status, &Derivatives::has_gap, &Derivatives::has_normal, &Derivatives::has_points,
               &Derivatives::gap_gradient, &Derivatives::normal, &Derivatives::point1, &Derivatives::point2,
               &Derivatives::common_normal, &Derivatives::evaluations, &Derivatives::gap_hessian, &Derivatives::parameters1,
               &Derivatives::parameters2);
  bind_column(type, "status", &Derivatives::status, kStatusDoc);
  bind_column(type, "has_gap", &Derivatives::has_gap, "(N,) of bool; whether gap_gradient is the gradient, or a subgradient");
  bind_column(type, "has_normal", &Derivatives::has_normal, "(N,) of bool; whether normal and gap_hessian are defined");
  bind_column(type, "has_points", &Derivatives::has_points, "(N,) of bool; whether point1 and point2 are defined");
  bind_column(type, "gap_gradient", &Derivatives::gap_gradient, "(N, 12), m/m and m/rad");
  bind_column(type, "normal", &Derivatives::normal, "(N, 3, 12), 1/m and 1/rad");
  bind_column(type, "point1", &Derivatives::point1, "(N, 3, 12), m/m and m/rad; the point of space, not of the material");
  bind_column(type, "point2", &Derivatives::point2, "(N, 3, 12), m/m and m/rad");
  bind_column(type, "common_normal", &Derivatives::common_normal, "(N, 3), unit; the normal of the answer, exact to rounding");
  bind_column(type, "evaluations", &Derivatives::evaluations, kEvaluationsDoc);
  bind_optional(type, "gap_hessian", &Derivatives::gap_hessian, "(N, 12, 12), m/(m m), m/(m rad), m/(rad rad); or None");
  bind_optional(
      type, "parameters1", &Derivatives::parameters1,
      "(N, 16), m/m for a length, m for an exponent or a taper: the derivatives of the gap by the parameters of shape 1, in the "
      "order of Shape.parameter_names, then zeros; or None");
  bind_optional(type, "parameters2", &Derivatives::parameters2, "The same of shape 2.");
}

}  // namespace

void bind_derivatives(py::module_& m) {
  bind_gradients_class(m);
  bind_derivatives_class(m);
  m.def("find_proximity_derivatives", &proximity_derivatives, kFindDerivativesDoc, py::arg("shapes1"), py::arg("poses1"),
        py::arg("shapes2"), py::arg("poses2"), py::arg("proximities"), py::arg("hessian") = true, py::arg("parameters") = true,
        py::arg("threads") = 0);
  m.def("find_plane_derivatives", &plane_derivatives, kPlaneDerivativesDoc, py::arg("shapes"), py::arg("poses"),
        py::arg("plane_normal"), py::arg("plane_offset"), py::arg("hessian") = true, py::arg("parameters") = true,
        py::arg("threads") = 0);
  m.def("find_gap_gradient", &gap_gradient, kGradientDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"),
        py::arg("poses2"), py::arg("proximities"), py::arg("threads") = 0);

  py::class_<Clearances> bounds(m, "Clearances", kClearancesDoc);
  bounds.def("__len__", [](const Clearances& self) { return self.count; });
  bind_columns(bounds, "pairs", &Clearances::lower_bound, &Clearances::normal, &Clearances::evaluations);
  bind_column(bounds, "lower_bound", &Clearances::lower_bound, "(N,), m; the gap is at least this");
  bind_column(bounds, "normal", &Clearances::normal, "(N, 3), unit, in the frame of body 1; it gives the bound");
  bind_column(bounds, "evaluations", &Clearances::evaluations, kEvaluationsDoc);
  m.def("find_clearances", &clearances, kFindClearancesDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"),
        py::arg("poses2"), py::arg("enough") = std::numeric_limits<double>::infinity(), py::arg("max_evaluations") = 3,
        py::arg("first_normals") = py::none(), py::arg("threads") = 0);
  m.def("are_farther_than", &farther, kFartherDoc, py::arg("shapes1"), py::arg("poses1"), py::arg("shapes2"), py::arg("poses2"),
        py::arg("distance"), py::arg("first_normals") = py::none(), py::arg("threads") = 0);
}

}  // namespace supernormal::python
