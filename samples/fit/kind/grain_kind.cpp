#include "grain_kind.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "model/empty_space.hpp"

namespace fit {
namespace {

/// The body as a start with its axis of this rank, from the shortest, as z.
Body with_z(const Body& body, Family family, const ShapeLimits& limits, std::size_t rank) {
  std::array<int, 3> order = {0, 1, 2};
  std::ranges::stable_sort(order, [&](int i, int j) { return body.half_axes[i] < body.half_axes[j]; });
  const int z = order[rank], x = order[rank == 2 ? 1 : 2];
  Body start = body;
  start.family = family;
  if (z == 2) return start;
  Matrix3 axes;
  axes.col(0) = Vector3::Unit(x);
  axes.col(2) = Vector3::Unit(z);
  axes.col(1) = axes.col(2).cross(axes.col(0));
  start = with_axes(start, axes);
  const double mean = 1 + std::sqrt((body.delta - 1) * (body.epsilon - 1));
  start.delta = limits.delta.value_or(mean);
  start.epsilon = limits.epsilon.value_or(mean);
  start.taper = 0;
  return start;
}

/// The fit near `start`, with all that fit_body() ignores and adds.
FittedBody refine(const Body& start, const Cloud& points, const FitSettings& settings) {
  const std::vector<std::size_t> gross = gross_outliers(points, settings, false);
  const Cloud kept = without(points, gross);
  std::vector<FittedBody> fitted = {refine_body(start, kept, settings)};
  const Body ordered = in_customary_order(fitted.front().body);
  const bool is_ordered =
      (ordered.half_axes - fitted.front().body.half_axes).isZero(0) && ordered.taper == fitted.front().body.taper;
  if (!is_ordered) fitted.front() = refine_body(ordered, kept, settings);
  add_gross_outliers(fitted, gross, points.points.size());
  return fitted.front();
}

Spread spread_of(std::span<const FittedBody> scans, const std::function<double(const FittedBody&)>& value,
                 const std::function<double(const FittedBody&)>& error) {
  const auto count = static_cast<double>(scans.size());
  Spread spread;
  for (const FittedBody& scan : scans) spread.mean += value(scan) / count;
  double square = 0, errors = 0, known = 0;
  for (const FittedBody& scan : scans) {
    square += std::pow(value(scan) - spread.mean, 2);
    const double each = error(scan);
    if (!std::isfinite(each)) continue;
    errors += each * each;
    known += 1;
  }
  spread.deviation = std::sqrt(square / (count - 1));
  spread.error = known > 0 ? std::sqrt(errors / known) : std::numeric_limits<double>::quiet_NaN();
  return spread;
}

/// A parameter that the fit reports as such.
Spread spread_of(std::span<const FittedBody> scans, double Body::*value, int parameter) {
  return spread_of(
      scans, [&](const FittedBody& scan) { return scan.body.*value; },
      [&](const FittedBody& scan) {
        const bool is_determined = scan.uncertainty.is_determined[static_cast<std::size_t>(parameter)];
        return is_determined ? scan.uncertainty.standard_error[parameter] : std::numeric_limits<double>::quiet_NaN();
      });
}

/// A half-axis over the first.
Spread spread_of_ratio(std::span<const FittedBody> scans, int axis) {
  const auto ratio = [=](const FittedBody& scan) { return scan.body.half_axes[axis] / scan.body.half_axes[0]; };
  return spread_of(scans, ratio, [&](const FittedBody& scan) {
    const auto& covariance = scan.uncertainty.covariance;  // of the logarithms
    const int i = kLogAxes + axis, j = kLogAxes;
    return ratio(scan) * std::sqrt(std::max(0.0, covariance(i, i) + covariance(j, j) - 2 * covariance(i, j)));
  });
}

}  // namespace

FitsByAxis fit_each_axis(const FittedBody& fitted, Family family, const Cloud& points, const FitSettings& settings) {
  FitSettings near = settings;
  near.family = family;
  near.is_whole = settings.is_whole || fitted.is_bounded_by_data;
  if (near.is_whole) near.largest_over_radius = kLargestOverRadiusOfWhole;
  if (fitted.is_bounded_by_data) {
    const Cloud kept = without(points, gross_outliers(points, settings, false));
    const Extent extent = extent_of(kept.points);
    const Cloud& surface = settings.surface.points.empty() ? kept : settings.surface;
    near.empty = moved(find_empty_space(normalized(surface, extent)), extent.size, extent.centre);
  }
  const auto refined = [&](const Body& start) { return refine(start, points, near); };
  const bool is_settled = fitted.body.family == family;
  if (family == Family::Ellipsoid || settings.limits.has_round_section) {
    const FittedBody only = is_settled ? fitted : refined(with_z(fitted.body, family, settings.limits, 0));
    return {only, only, only};
  }
  FitsByAxis fits;
  for (std::size_t rank = 0; rank < fits.size(); ++rank) {
    const Body start = with_z(fitted.body, family, settings.limits, rank);
    const bool is_same = is_settled && (start.half_axes - fitted.body.half_axes).isZero(0);
    fits[rank] = is_same ? fitted : refined(start);
  }
  return fits;
}

std::size_t common_axis(std::span<const FitsByAxis> scans) {
  std::array<double, 3> sums{};
  for (const FitsByAxis& fits : scans) {
    for (std::size_t rank = 0; rank < 3; ++rank) {
      sums[rank] += std::pow(fits[rank].uncertainty.sigma / size_of(fits[rank].body), 2);
    }
  }
  return static_cast<std::size_t>(std::ranges::min_element(sums) - sums.begin());
}

double size_of(const Body& body) { return std::cbrt(make_shape(body)->mass_properties().volume); }

GrainKind find_kind(std::span<const FittedBody> scans) {
  if (scans.size() < 2) throw std::invalid_argument(std::to_string(scans.size()) + " scans; a kind of grain takes at least 2");
  GrainKind kind;
  double sum = 0, square = 0;
  for (const FittedBody& scan : scans) kind.sizes.push_back(size_of(scan.body));
  const auto count = static_cast<double>(scans.size());
  for (const double size : kind.sizes) sum += std::log(size) / count;
  for (const double size : kind.sizes) square += std::pow(std::log(size) - sum, 2);
  kind.median = std::exp(sum);
  kind.geometric_deviation = std::exp(std::sqrt(square / (count - 1)));
  kind.b_over_a = spread_of_ratio(scans, 1);
  kind.c_over_a = spread_of_ratio(scans, 2);
  kind.delta = spread_of(scans, &Body::delta, kLogDelta);
  kind.epsilon = spread_of(scans, &Body::epsilon, kLogEpsilon);
  kind.taper = spread_of(scans, &Body::taper, kTaper);
  kind.body.family = scans.front().body.family;
  kind.body.half_axes = {1, kind.b_over_a.mean, kind.c_over_a.mean};
  kind.body.delta = kind.delta.mean;
  kind.body.epsilon = kind.epsilon.mean;
  // Relative to the limit of a convex body, which depends on epsilon.
  double relative = 0;
  for (const FittedBody& scan : scans) relative += scan.body.taper / taper_limit(scan.body.epsilon) / count;
  kind.body.taper = relative * taper_limit(kind.body.epsilon);
  kind.body.half_axes *= kind.median / size_of(kind.body);
  return kind;
}

}  // namespace fit
