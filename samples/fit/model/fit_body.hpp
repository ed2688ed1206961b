// Fits one body to data.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <supernormal/shapes/superellipsoid.hpp>
#include <vector>

#include "body.hpp"
#include "cloud.hpp"
#include "input/read_data.hpp"
#include "least_squares.hpp"
#include "uncertainty.hpp"

namespace fit {

/// How the data scatter about the surface.
enum class Noise {
  Isotropic,    ///< in all directions: points then lie outside a convex surface more often than inside
  AlongNormal,  ///< along the normal of the surface only
};

/// Where the body may extend beyond the data.
enum class Sides {
  Auto,  ///< nowhere, if no body of the families fits the data within the noise
  All,   ///< nowhere: the data show all sides
  Some,  ///< where nothing was scanned
};

struct FitSettings {
  std::optional<Family> family;  ///< empty: chosen by the data
  Noise noise = Noise::Isotropic;
  bool rejects_outliers = true;  ///< ignores points farther away than kOutlier standard deviations
  /// Limit of the half-axes, relative to the radius of the data (radius_of). One-sided data do not bound the body.
  double largest_over_radius = 3;
  /// Whether the data cover the whole surface (a closed mesh). Then bodies that protrude from the data are not considered.
  bool is_whole = false;
  Sides sides = Sides::Auto;
  /// Of a closed mesh; one more residual of the fit of a body.
  std::optional<VolumeTarget> volume = {};
  ShapeLimits limits = {};
  /// More points of the same surface with normals, such as of a mesh, from which the empty space is found. Empty: the points to
  /// fit.
  Cloud surface = {};
  /// The mesh, if the data are one: the limits of a union hold for it, as in the report. Without triangles: for the points to fit.
  Data mesh = {};
  /// Where no body shall be. fit_body() and fit_union() find it.
  EmptySpace empty = {};
  int threads = 1;
  std::function<void(const std::string& step)> progress = {};  ///< called before each step that may take seconds
};

constexpr double kOutlier = 5;

/// Limit of the half-axes, relative to the radius of the data, if the data cover the whole surface. Half of a segment in the data
/// is at most their radius, except that radius_of() ignores the outermost points.
constexpr double kLargestOverRadiusOfWhole = 1.5;

/// The sharpest edge of the families, with the largest exponent, misses the edge of a box by this fraction of a half-axis. Smaller
/// distances count as equal.
const double kSharpestEdge = 1 - std::exp2(-1 / supernormal::Superellipsoid::kMaxExponent);

struct FittedBody {
  Body body;
  Uncertainty uncertainty;
  std::vector<std::size_t> outliers;  ///< indices of the ignored points
  std::size_t inliers = 0;            ///< number of the other points
  /// Whether the smallest radius of curvature is below two standard deviations of the noise. Noise then hides how sharp the edges
  /// are.
  bool is_edge_below_noise = false;
  /// Whether a half-axis ended at its limit, several times the extent of the data.
  bool is_at_largest_size = false;
  /// Whether the body was kept from extending beyond the data (Sides). A body that fits within the noise is not: its hidden sides
  /// follow from those that the data show.
  bool is_bounded_by_data = false;
  /// Whether the points are the vertices of a mesh, which lie on the body, with facets below.
  bool is_tessellated = false;
};

/// The bodies of fits, and all points that these ignore.
std::vector<Body> bodies_of(std::span<const FittedBody> fitted);
std::vector<std::size_t> outliers_of(std::span<const FittedBody> fitted);

/// Whether a body fits data of the extent `size` within their noise.
bool is_within_noise(const Uncertainty& uncertainty, double size);

/// The smallest number of points for a family: one more than its parameters, for error bars.
std::size_t least_points(Family family);

/// Throws std::invalid_argument unless there are at least `least` finite points that are not all at one place, on a line or in a
/// plane.
void require_points(const Cloud& cloud, std::size_t least);

/// Fits the points and computes error measures. Throws like require_points().
FittedBody fit_body(const Cloud& cloud, const FitSettings& settings = {});

/// The points that fit_body() and fit_union() ignore before the search: isolated(), and cut_off() with at most a fifth of the
/// points. For a union the limit is also below the number of points that bounds a body.
std::vector<std::size_t> gross_outliers(const Cloud& cloud, const FitSettings& settings, bool is_union);

/// Adds the gross outliers to the outliers of a fit to the rest, and converts the indices to the whole cloud.
void add_gross_outliers(std::vector<FittedBody>& fitted, std::span<const std::size_t> gross, std::size_t points);

/// Only descends from `start` on all points. Use it for a start near the solution.
FittedBody refine_body(const Body& start, const Cloud& cloud, const FitSettings& settings = {});

/// The settings of a fit to the image of the data under x -> scale x + offset.
FitSettings moved(const FitSettings& settings, double scale, const Vector3& offset);

/// Finds the best body for data of extent 1, or a part of them, without error bars. The cost is infinite if there is none.
struct Candidate {
  Body body;
  double mean_square = std::numeric_limits<double>::infinity();
};
Candidate search_body(const Cloud& cloud, Family family, const FitSettings& settings);

}  // namespace fit
