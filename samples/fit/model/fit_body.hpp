// The body that fits data best.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "body.hpp"
#include "cloud.hpp"
#include "uncertainty.hpp"

namespace fit {

/// How data scatter about the surface.
enum class Noise {
  Isotropic,    ///< alike in all directions: then points lie outside of a convex surface more often than inside
  AlongNormal,  ///< along the surface's normal only
};

struct FitSettings {
  std::optional<Family> family;  ///< nothing: the one that the data call for
  Noise noise = Noise::Isotropic;
  bool rejects_outliers = true;  ///< leaves out points farther away than kOutlier standard deviations
  /// No half-axis becomes longer than this times the data's radius (radius_of): data of one side only do not bound the body.
  double largest_over_radius = 3;
  /// Whether the data are all of the surface (a closed mesh): then no body is looked for that stands out of them.
  bool is_whole = false;
  int threads = 1;
  std::function<void(const std::string& step)> progress = {};  ///< is told what is done next, where it may take seconds
};

constexpr double kOutlier = 5;

/// No half-axis becomes longer than this times the data's radius where data bound the body all around: half of a segment in the
/// data is not longer than their radius, of which radius_of() leaves out the outermost points.
constexpr double kLargestOverRadiusOfWhole = 1.5;

struct FittedBody {
  Body body;
  Uncertainty uncertainty;
  std::vector<std::size_t> outliers;  ///< indices of points that were left out
  std::size_t inliers = 0;            ///< how many others there are
  /// Whether the smallest radius of curvature is below twice the noise's standard deviation: noise then hides how sharp edges are.
  bool is_edge_below_noise = false;
  /// Half-axes that ended at the largest length which is allowed, several times the extent of the data.
  bool is_at_largest_size = false;
};

/// The least number of points for a family: one more than the numbers of the body, to have an error bar.
std::size_t least_points(Family family);

/// std::invalid_argument unless there are `least` points, they are finite, and they are not all in one place, line or plane.
void require_points(const Cloud& cloud, std::size_t least);

/// Fits the points and measures how well. std::invalid_argument as require_points().
FittedBody fit_body(const Cloud& cloud, const FitSettings& settings = {});

/// The points that fit_body() and fit_union() leave out before they look for bodies, cut_off() from the others: up to a fifth of
/// them, or up to as many as bound no body of a union.
std::vector<std::size_t> gross_outliers(const Cloud& cloud, const FitSettings& settings, bool is_union);

/// The rest of the cloud; and the indices of the outliers of a fit to the rest, with the gross ones, in the whole cloud.
Cloud without(const Cloud& cloud, std::span<const std::size_t> indices);
void add_gross_outliers(std::vector<FittedBody>& fitted, std::span<const std::size_t> gross, std::size_t points);

/// Only descends from `start` on all points: for a start that is near.
FittedBody refine_body(const Body& start, const Cloud& cloud, const FitSettings& settings = {});

/// Finds the best body for (a part of) data of extent 1, without error bars; infinite cost where there is none.
struct Candidate {
  Body body;
  double mean_square = std::numeric_limits<double>::infinity();
};
Candidate search_body(const Cloud& cloud, Family family, const FitSettings& settings);

}  // namespace fit
