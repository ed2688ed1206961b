#include "report.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "model/distance.hpp"
#include "results.hpp"

namespace fit {
namespace {

std::string row(const char* name, double value, const FittedBody& fitted, int parameter) {
  const Uncertainty& uncertainty = fitted.uncertainty;
  const bool is_place = parameter < kRotation;
  const int digits = is_place ? digits_of(value, fitted.body.half_axes.minCoeff(), 7) : 7;
  if (uncertainty.is_fixed[static_cast<std::size_t>(parameter)]) return format("  %-22s %14.*g   fixed\n", name, digits, value);
  if (!uncertainty.is_determined[static_cast<std::size_t>(parameter)]) {
    return format("  %-22s %14.*g   not determined by the data\n", name, digits, value);
  }
  return format("  %-22s %14.*g ± %.2g\n", name, digits, value, uncertainty.standard_error[parameter]);
}

std::string orientation_rows(const FittedBody& fitted) {
  const Eigen::Quaterniond& q = fitted.body.orientation;
  std::string text = format("  orientation (w, x, y, z)  %.7g %.7g %.7g %.7g\n", q.w(), q.x(), q.y(), q.z());
  for (int i = kRotation; i < kRotation + 3; ++i) {
    const char axis = "xyz"[i - kRotation];
    const double error = fitted.uncertainty.standard_error[i] * 180 / std::numbers::pi;
    const bool is_determined = fitted.uncertainty.is_determined[static_cast<std::size_t>(i)];
    text += is_determined ? format("    rotation about its %c-axis ± %.2g degrees\n", axis, error)
                          : format("    rotation about its %c-axis not determined by the data\n", axis);
  }
  return text;
}

std::string remarks(const FittedBody& fitted) {
  const Uncertainty& uncertainty = fitted.uncertainty;
  std::string text;
  if (uncertainty.is_significant) {
    text += format(
        "  Neighbouring distances agree with one another (lack of fit F = %.3g; independent ones: 1): the body is not of this "
        "family,\n"
        "  or the noise is no noise. The standard errors are larger by the root of F.\n",
        uncertainty.lack_of_fit);
  }
  if (fitted.is_edge_below_noise) {
    text +=
        "  Its sharpest edges are sharper than the noise, which hides how sharp: exponents may be wrong by more than they say.\n";
  }
  if (fitted.is_at_largest_size)
    text += "  A half-axis ended at the largest length that is allowed: the data do not bound the body.\n";
  return text;
}

std::string inertia_row(const Solid& solid, const Vector3& errors = Vector3::Zero()) {
  const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(solid.inertia, Eigen::EigenvaluesOnly);
  const Vector3& moments = eigen.eigenvalues();
  std::string text;
  for (int i = 0; i < 3; ++i) {
    text += format(i == 0 ? "%.6g" : " %.6g", moments[i]);
    if (errors[i] > 0) text += format(" ± %.2g", errors[i]);
  }
  return text;
}

}  // namespace

std::string describe(const FittedBody& fitted) {
  const Body& body = fitted.body;
  std::string text = std::string(name_of(body.family)) + "\n";
  for (int i = 0; i < 3; ++i)
    text += row(("half-axis " + std::string(1, "abc"[i])).c_str(), body.half_axes[i], fitted, kLogAxes + i);
  if (body.family != Family::Ellipsoid) {
    text += row("delta", body.delta, fitted, kLogDelta);
    text += row("epsilon", body.epsilon, fitted, kLogEpsilon);
  }
  if (body.family == Family::Superovoid) text += row("taper_x = taper_y", body.taper, fitted, kTaper);
  for (int i = 0; i < 3; ++i) text += row(("centre " + std::string(1, "xyz"[i])).c_str(), body.position[i], fitted, kPosition + i);
  text += orientation_rows(fitted);
  text += format("  %zu points, standard deviation of their distances %.4g; %zu outliers left out\n", fitted.inliers,
                 fitted.uncertainty.sigma, fitted.outliers.size());
  return text + remarks(fitted);
}

std::string describe_outliers(std::span<const FittedBody> fitted, const Cloud& cloud) {
  constexpr std::size_t kNamed = 5;
  std::vector<DistanceFunction> functions;
  for (const FittedBody& each : fitted) functions.emplace_back(each.body);
  std::vector<std::pair<double, std::size_t>> outliers;
  for (const FittedBody& each : fitted) {
    for (const std::size_t i : each.outliers) outliers.emplace_back(least_distance(functions, cloud.points[i]), i);
  }
  if (outliers.empty()) return "";
  std::ranges::sort(outliers, [](const auto& a, const auto& b) {
    return std::abs(a.first) != std::abs(b.first) ? std::abs(a.first) > std::abs(b.first) : a.second < b.second;
  });
  std::string text = format("%zu outliers do not count (--outliers keep: they do)%s\n", outliers.size(),
                            outliers.size() > kNamed ? "; the farthest:" : ":");
  for (const auto& [distance, i] : std::span(outliers).first(std::min(outliers.size(), kNamed))) {
    const Vector3& x = cloud.points[i];
    text += format("  point %zu at (%.7g, %.7g, %.7g), %.4g %s the surface\n", i + 1, x.x(), x.y(), x.z(), std::abs(distance),
                   distance < 0 ? "below" : "above");
  }
  return text;
}

std::vector<std::string> doubts_about(std::span<const FittedBody> fitted, const FitError& error) {
  constexpr double kMostVolume = 0.1, kMostOutliers = 0.2, kMostOpenness = 0.2;
  std::vector<std::string> doubts;
  const auto add = [&](const std::string& what, double value, double most, const std::string& of, const char* advice) {
    if (value > most)
      doubts.push_back(what + format(" %.3g %% of ", 100 * value) + of + format(" (at most %g %%); ", 100 * most) + advice);
  };
  constexpr const char* kMoreBodies = "try more --bodies";
  add("the root mean square distance of the data from the surface is", error.rms / error.radius, kMostDistance, "their radius",
      kMoreBodies);
  const bool is_bounded = std::ranges::any_of(fitted, &FittedBody::is_bounded_by_data);
  // Where a body of the families fits, its other sides follow, and the error of the volume says how well. It is not known (0) of a
  // quick fit.
  const bool is_free = error.is_hull && !is_bounded;
  const bool follows = is_free && error.volume_error > 0 && error.volume_error < kMostVolume * error.body.volume;
  if (!follows && !fitted.front().is_tessellated)
    add("the surface extends beyond the data by", error.reach / error.radius, kMostReach, "their radius",
        is_free ? "scan more sides" : kMoreBodies);
  if (!error.is_hull)
    add("the volume differs by", std::abs(error.body.volume / error.data.volume - 1), kMostVolume, "the closed mesh's",
        kMoreBodies);
  if (error.is_hull && is_bounded)
    add("no body of the families fits, and the data hide", error.openness, kMostOpenness, "the surface", "scan more sides");
  std::size_t outliers = 0, points = 0;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    outliers += fitted[k].outliers.size();
    points += fitted[k].outliers.size() + fitted[k].inliers;
    if (fitted[k].is_at_largest_size && !fitted[k].is_bounded_by_data)
      doubts.push_back(format("body %zu: the data do not bound a half-axis, which ended at its limit; scan more sides", k + 1));
  }
  add("the outliers are", static_cast<double>(outliers) / static_cast<double>(points), kMostOutliers, "the points",
      "remove what is not the object, or --outliers keep");
  return doubts;
}

std::string describe(const FitError& error) {
  std::string text =
      format("distance of the data from the surface: root mean square %.4g, largest %.4g\n", error.rms, error.to_body);
  text += format("distance of the surface from the data: largest %.4g\n", error.to_data);
  text += format("reach of the surface beyond the data: %.4g, %.2g %% of their radius %.4g\n", error.reach,
                 100 * error.reach / error.radius, error.radius);
  const char* const whose = error.is_hull ? "convex hull of the data" : "closed mesh";
  text += format("volume %.6g", error.body.volume);
  if (error.volume_error > 0) text += format(" ± %.2g", error.volume_error);
  text += format("; %s %.6g (%+.2f %%)\n", whose, error.data.volume, 100 * (error.body.volume / error.data.volume - 1));
  text += "principal moments of inertia, density 1: " + inertia_row(error.body, error.moment_errors) + "; " + whose + " " +
          inertia_row(error.data) + "\n";
  text += format("centroids are %.4g apart\n", (error.body.centroid - error.data.centroid).norm());
  return text;
}

}  // namespace fit
