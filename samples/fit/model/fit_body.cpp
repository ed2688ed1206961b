#include "fit_body.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include "distance.hpp"
#include "starts.hpp"

namespace fit {

namespace {

// The lengths below are for data of extent 1.
constexpr double kRounding = 1e-9;     // smaller distances count as rounding
constexpr double kUnsettled = 2e-3;    // noise allowed until a descent has ended: flat faces may fit much earlier
constexpr std::size_t kLarge = 10000;  // of more points, some find the body, and all are used only for its last digits
constexpr double kHuber = 1.345;       // standard deviations: 95 % efficiency for normal noise

/// The standard deviation of normal noise with this median absolute value.
double robust_sigma(std::span<const double> residuals) {
  std::vector<double> sizes(residuals.size());
  std::ranges::transform(residuals, sizes.begin(), [](double residual) { return std::abs(residual); });
  return std::max(1.4826 * median(std::move(sizes)), kRounding);
}

struct Measured {
  std::vector<Witness> witnesses;
  std::vector<double> distances;
};

Measured measure(const Body& body, std::span<const Vector3> points) {
  Measured result;
  const DistanceFunction function(body);
  for (const Vector3& x : points) {
    const std::optional<Witness> witness = function.find(x);
    if (!witness) throw std::runtime_error("the distance of a point from the fitted body cannot be computed");
    result.witnesses.push_back(*witness);
    result.distances.push_back(witness->distance);
  }
  return result;
}

/// Whether the normals of the data point out of the body. One-sided data also fit the far side of a body.
bool is_right_side_out(const Body& body, const Cloud& cloud) {
  if (cloud.normals.empty()) return true;
  const Measured measured = measure(body, cloud.points);
  double sum = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) sum += measured.witnesses[i].normal.dot(cloud.normals[i]);
  return sum > 0;
}

double mean_square(const LeastSquaresResult& result, std::size_t points) { return 2 * result.cost / static_cast<double>(points); }

/// Whether two descents are converging to the same body.
bool are_alike(const Candidate& a, const Candidate& b) {
  constexpr double kAlike = 0.1;
  return (a.body.position - b.body.position).norm() < kAlike && std::abs(a.mean_square / b.mean_square - 1) < kAlike &&
         std::abs(std::log(a.body.half_axes.prod() / b.body.half_axes.prod())) < kAlike;
}

/// Descends from each start on the points. Keeps the best `count` distinct results.
std::vector<Candidate> descend(const std::vector<Candidate>& starts, const Cloud& cloud, const LeastSquaresSettings& settings,
                               std::size_t count) {
  std::vector<Candidate> ends;
  for (const Candidate& start : starts) {
    const LeastSquaresResult result = minimize_distances(start.body, cloud.points, {}, settings);
    if (!std::isfinite(result.cost) || !is_right_side_out(result.body, cloud)) continue;
    ends.push_back({result.body, mean_square(result, cloud.points.size())});
  }
  std::ranges::stable_sort(ends, {}, &Candidate::mean_square);
  std::vector<Candidate> kept;
  for (const Candidate& end : ends) {
    if (kept.size() == count) break;
    if (std::ranges::none_of(kept, [&](const Candidate& other) { return are_alike(end, other); })) kept.push_back(end);
  }
  return kept;
}

/// The state of the last descent on all points.
struct Descent {
  Body body;
  std::vector<std::size_t> inliers;
  Measured measured;            // at all points
  std::vector<double> offsets;  // at all points
};

std::vector<double> residuals_of(const Descent& descent) {
  std::vector<double> residuals;
  for (const std::size_t i : descent.inliers) residuals.push_back(descent.measured.distances[i] - descent.offsets[i]);
  return residuals;
}

double root_mean_square(std::span<const double> values) {
  const double square = std::inner_product(values.begin(), values.end(), values.begin(), 0.0);
  return std::sqrt(square / static_cast<double>(values.size()));
}

std::vector<Witness> inlier_witnesses(const Descent& descent) {
  std::vector<Witness> witnesses;
  witnesses.reserve(descent.inliers.size());
  for (const std::size_t i : descent.inliers) witnesses.push_back(descent.measured.witnesses[i]);
  return witnesses;
}

/// The change of the body's parameters by these changes of the inliers' distances, as the largest over all combinations of
/// parameters, in standard errors. It is the norm of the projection of the changes on the column space of the Jacobian, over sigma.
double standard_errors_moved(const Descent& descent, const std::vector<double>& changes, double sigma) {
  const DistanceFunction function(descent.body);
  const Eigen::Index count = parameter_count(descent.body.family);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(count);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (changes[i] != 0) pull += changes[i] * function.gradient(descent.measured.witnesses[i]).head(count);
  }
  if (pull.isZero(0)) return 0;
  const Eigen::MatrixXd information = normal_matrix(function, inlier_witnesses(descent)).topLeftCorner(count, count);
  const Eigen::VectorXd move = information.completeOrthogonalDecomposition().solve(pull);
  return std::sqrt(std::max(pull.dot(move), 0.0)) / sigma;
}

/// The bias of the distances of all points by noise.
std::vector<double> offsets_of(const Descent& descent, const FitSettings& settings, double sigma) {
  std::vector<double> offsets(descent.measured.witnesses.size(), 0.0);
  if (settings.noise != Noise::Isotropic || !(sigma > kRounding)) return offsets;
  const DistanceFunction function(descent.body);
  std::ranges::transform(descent.measured.witnesses, offsets.begin(),
                         [&](const Witness& witness) { return noise_offset(function, witness, sigma); });
  return offsets;
}

/// Updates distances, noise bias and outliers. Returns whether another descent would change the body so much that its error grows
/// by 5 %.
bool update(Descent& descent, const Cloud& cloud, const FitSettings& settings, double least_sigma) {
  constexpr double kSettled = 0.3;  // standard errors; sqrt(1 + 0.3^2) is about 1.05
  const std::size_t points = cloud.points.size();
  descent.measured = measure(descent.body, cloud.points);
  if (descent.offsets.empty()) descent.offsets.assign(points, 0.0);
  const std::vector<double> residuals = residuals_of(descent);
  const double sigma = settings.rejects_outliers ? robust_sigma(residuals) : root_mean_square(residuals);
  std::vector<double> offsets = offsets_of(descent, settings, sigma);
  std::vector<bool> was_inlier(points, false);
  for (const std::size_t i : descent.inliers) was_inlier[i] = true;
  // Flat faces may fit exactly and lower the median while the rest is still converging. So the mean square counts, too.
  const double limit = settings.rejects_outliers ? kOutlier * std::max({sigma, least_sigma, root_mean_square(residuals) / 2})
                                                 : std::numeric_limits<double>::infinity();
  descent.inliers.clear();
  std::vector<double> changes(points, 0.0);
  for (std::size_t i = 0; i < points; ++i) {
    const double residual = descent.measured.distances[i] - offsets[i];
    const bool is_inlier = std::abs(residual) <= limit;
    if (is_inlier) descent.inliers.push_back(i);
    if (is_inlier != was_inlier[i]) {
      changes[i] = residual;
    } else if (is_inlier) {
      changes[i] = offsets[i] - descent.offsets[i];
    }
  }
  descent.offsets = std::move(offsets);
  return standard_errors_moved(descent, changes, sigma) > kSettled;
}

void solve(Descent& descent, const Cloud& cloud, const LeastSquaresSettings& settings) {
  const Cloud chosen = selected(cloud, descent.inliers);
  std::vector<double> offsets;
  for (const std::size_t i : descent.inliers) offsets.push_back(descent.offsets[i]);
  descent.body = minimize_distances(descent.body, chosen.points, offsets, settings).body;
}

// A closed mesh has no noise. A body that misses it by several per cent of its size has another shape, and further digits are
// useless. Such bodies have the largest exponents and converge slowest.
constexpr double kOtherShape = 0.02;

bool is_other_shape(double mean_square, const FitSettings& search) {
  return search.is_whole && mean_square > kOtherShape * kOtherShape;
}

/// Least squares from a start and its mean square, on all points except outliers. Repeats until the outliers and the noise bias are
/// stable.
Descent descend_on_all(const Candidate& start, const Cloud& cloud, const FitSettings& settings, int rounds, int steps = 12) {
  Descent descent{start.body, {}, {}, {}};
  descent.inliers.resize(cloud.points.size());
  std::iota(descent.inliers.begin(), descent.inliers.end(), std::size_t{0});
  LeastSquaresSettings least_squares;
  least_squares.largest_half_axis = settings.largest_over_radius * radius_of(cloud.points);
  // A step with a smaller decrease of the cost changes no parameter by more than a tenth of its standard error.
  least_squares.tolerance = 1e-2 / static_cast<double>(cloud.points.size());
  least_squares.threads = settings.threads;
  least_squares.max_iterations = steps;
  least_squares.empty = settings.empty;
  least_squares.volume = settings.volume;
  least_squares.limits = settings.limits;
  if (is_other_shape(start.mean_square, settings)) least_squares.distance_tolerance = kRoughTolerance;
  for (int round = 0; round < rounds; ++round) {
    const bool has_changed = update(descent, cloud, settings, round == 0 ? kUnsettled : 0);
    if (round > 0 && !has_changed) return descent;
    solve(descent, cloud, least_squares);
  }
  descent.measured = measure(descent.body, cloud.points);
  return descent;
}

/// The result in the original frame of the data, which were normalized by `extent`.
FittedBody finish(const Descent& descent, const Extent& extent, const Cloud& cloud, const FitSettings& settings) {
  FittedBody fitted;
  fitted.outliers = others_than(descent.inliers, cloud.points.size());
  fitted.inliers = descent.inliers.size();
  fitted.uncertainty = find_uncertainty(descent.body, inlier_witnesses(descent), residuals_of(descent), settings.limits);
  const double sharpest = make_shape(descent.body)->min_curvature_radius_estimate();
  fitted.is_edge_below_noise =
      settings.noise == Noise::Isotropic && fitted.uncertainty.sigma > kRounding && sharpest < 2 * fitted.uncertainty.sigma;
  fitted.uncertainty.sigma *= extent.size;
  fitted.uncertainty.standard_error.segment<3>(kPosition) *= extent.size;
  fitted.uncertainty.covariance.middleRows<3>(kPosition) *= extent.size;
  fitted.uncertainty.covariance.middleCols<3>(kPosition) *= extent.size;
  fitted.uncertainty.standard_error.segment<3>(kLogAxes) *= extent.size;
  fitted.is_at_largest_size = descent.body.half_axes.maxCoeff() > 0.999 * settings.largest_over_radius * radius_of(cloud.points);
  fitted.is_bounded_by_data = settings.empty.grid != nullptr && !is_within_noise(fitted.uncertainty, 1);
  fitted.body = moved(descent.body, extent.size, extent.centre);
  return fitted;
}

/// A descent on many points with a loss function as narrow as the noise. The mean square excludes points far beyond the noise.
void polish(Candidate& candidate, const Cloud& some, const Cloud& many, LeastSquaresSettings settings, const FitSettings& search) {
  settings.empty = search.empty;
  const bool rejects_outliers = search.rejects_outliers;
  if (rejects_outliers) {
    settings.loss_width = kHuber * std::max(kUnsettled, robust_sigma(measure(candidate.body, many.points).distances));
  }
  const bool is_rough = is_other_shape(candidate.mean_square, search);
  settings.max_iterations = is_rough ? 12 : 50;
  settings.tolerance = is_rough ? 1e-2 / static_cast<double>(some.points.size()) : 1e-8;
  settings.distance_tolerance = is_rough ? kRoughTolerance : kFineTolerance;
  candidate.body = minimize_distances(candidate.body, (is_rough ? some : many).points, {}, settings).body;
  const std::vector<double> distances = measure(candidate.body, many.points).distances;
  const double limit =
      rejects_outliers ? kOutlier * std::max(kUnsettled, robust_sigma(distances)) : std::numeric_limits<double>::infinity();
  double square = 0;
  for (const double distance : distances) square += std::min(distance * distance, limit * limit);
  candidate.mean_square = square / static_cast<double>(distances.size()) + penalty_of(candidate.body, search.empty);
}

/// Descends from the starts on more and more points, with fewer and fewer bodies.
Candidate best_descent(const std::vector<Body>& starts, const Cloud& cloud, const FitSettings& search) {
  constexpr double kHopeless = 4;  // times the smallest mean square
  const Cloud few = thinned(cloud, 200), some = thinned(cloud, 800), many = thinned(cloud, 3000);
  LeastSquaresSettings settings;
  settings.largest_half_axis = search.largest_over_radius * radius_of(many.points);
  settings.max_iterations = 6;
  settings.tolerance = 1e-3;
  settings.loss_width = 0.1;
  if (search.is_whole) settings.distance_tolerance = kRoughTolerance;
  settings.empty = search.empty;
  settings.volume = search.volume;
  settings.limits = search.limits;
  std::vector<Candidate> candidates(starts.size());
  std::ranges::transform(starts, candidates.begin(), [](const Body& start) { return Candidate{start}; });
  candidates = descend(candidates, few, settings, 10);
  // For a closed mesh the starts lie in its box, and polishing continues the descent. 25 iterations of the sharpest tapered bodies,
  // at 30 evaluations per point, would take most of the time for a tetrahedron.
  settings.max_iterations = search.is_whole ? 12 : 25;
  settings.tolerance = 1e-4;
  candidates = descend(candidates, some, settings, 3);
  if (candidates.empty()) return {};
  const double limit = kHopeless * candidates.front().mean_square;
  std::erase_if(candidates, [&](const Candidate& candidate) { return candidate.mean_square > limit; });
  for (Candidate& candidate : candidates) polish(candidate, some, many, settings, search);
  return *std::ranges::min_element(candidates, {}, &Candidate::mean_square);
}

/// The body with each of its axes as z, as starts of another family.
std::vector<Body> make_starts_near(Body body, Family family) {
  Matrix3 cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  body.family = family;
  const Body second = with_axes(body, cycle);
  return {body, second, with_axes(second, cycle)};
}

/// The number of independent distances. Correlated neighbours count for less (see find_uncertainty).
double independent_points(const Candidate& candidate, const Cloud& cloud) {
  const Measured measured = measure(candidate.body, cloud.points);
  const Uncertainty uncertainty = find_uncertainty(candidate.body, measured.witnesses, measured.distances);
  const auto points = static_cast<double>(cloud.points.size());
  return uncertainty.is_significant ? points / uncertainty.lack_of_fit : points;
}

/// The family with the smallest Bayesian information criterion, n ln(mean square) + k ln n. Distances below rounding count as
/// equal.
Candidate best_family(const Cloud& cloud, const FitSettings& settings) {
  if (settings.family) return search_body(cloud, *settings.family, settings);
  std::vector<Candidate> candidates;
  for (const Family family : {Family::Ellipsoid, Family::Superellipsoid, Family::Superovoid}) {
    if (cloud.points.size() < least_points(family)) continue;
    if (family == Family::Ellipsoid && (settings.limits.delta || settings.limits.epsilon)) continue;
    if (settings.progress) settings.progress(std::string("looking for the best ") + name_of(family));
    // The taper is a small change: start near the body without it.
    const bool is_near = family == Family::Superovoid && !candidates.empty();
    const Candidate candidate = is_near ? best_descent(make_starts_near(candidates.back().body, family), cloud, settings)
                                        : search_body(cloud, family, settings);
    if (std::isfinite(candidate.mean_square)) candidates.push_back(candidate);
    if (candidate.mean_square < kRounding * kRounding) break;
  }
  if (candidates.empty()) return {};
  const double points = std::max(independent_points(candidates.back(), cloud), std::exp(1.0));
  return *std::ranges::min_element(candidates, {}, [&](const Candidate& candidate) {
    return points * std::log(candidate.mean_square + kRounding * kRounding) +
           parameter_count(candidate.body.family) * std::log(points);
  });
}

/// Refuses data (of extent 1) on a line or in a plane.
void require_three_dimensions(const Cloud& data) {
  constexpr double kFlat = 1e-6;  // ten times the rounding of single-precision coordinates
  Matrix3 scatter = Matrix3::Zero();
  for (const Vector3& x : data.points) scatter += x * x.transpose() / static_cast<double>(data.points.size());
  const Vector3 squares = Eigen::SelfAdjointEigenSolver<Matrix3>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  if (squares[0] > kFlat * kFlat) return;
  const char* const where = squares[1] > kFlat * kFlat ? "in a plane" : "on a line";
  throw std::invalid_argument(std::string("the points lie ") + where + ", to a millionth of their extent, and bound no body");
}

FittedBody fit_normalized(const Cloud& data, const Extent& extent, FitSettings settings) {
  if (settings.is_whole) settings.largest_over_radius = kLargestOverRadiusOfWhole;
  const Candidate best = best_family(thinned(data, 3000), settings);
  if (!std::isfinite(best.mean_square)) {
    throw std::runtime_error(
        data.normals.empty()
            ? "no body fits: every descent failed"
            : "no body fits: every descent failed or ended with its normals against those of the data, which must point outwards");
  }
  if (data.points.size() <= kLarge)
    return finish(descend_on_all({in_customary_order(best.body), best.mean_square}, data, settings, 4), extent, data, settings);
  // Most of the search uses only some of the points. If the error of an estimate decreases with their number, one Newton step on
  // all points is as good as the minimum (Le Cam's one-step estimator; van der Vaart, Asymptotic Statistics, section 5.7).
  const Body near = descend_on_all(best, thinned(data, kLarge), settings, 4).body;
  return finish(descend_on_all({in_customary_order(near), best.mean_square}, data, settings, 2, 2), extent, data, settings);
}

FittedBody fit_kept(const Cloud& cloud, const FitSettings& settings) {
  require_points(cloud, least_points(settings.family.value_or(Family::Ellipsoid)));
  const Extent extent = extent_of(cloud.points);
  const Cloud data = normalized(cloud, extent);
  FitSettings of_data = moved(settings, 1 / extent.size, -extent.centre / extent.size);
  if (settings.sides != Sides::All) {
    // Half of a body's surface determines the rest, but only if it is a body of the families.
    const FittedBody fitted = fit_normalized(data, extent, of_data);
    if (settings.sides == Sides::Some || is_within_noise(fitted.uncertainty, extent.size)) return fitted;
    if (settings.progress) settings.progress("no body fits within the noise: searching for one that ends with the data");
  }
  of_data.is_whole = true;
  of_data.empty = find_empty_space(settings.surface.points.empty() ? data : normalized(settings.surface, extent));
  return fit_normalized(data, extent, of_data);
}

}  // namespace

bool is_within_noise(const Uncertainty& uncertainty, double size) {
  return !uncertainty.is_significant || uncertainty.sigma < kSharpestEdge * size;
}

std::size_t least_points(Family family) { return static_cast<std::size_t>(parameter_count(family)) + 1; }

void require_points(const Cloud& cloud, std::size_t least) {
  if (cloud.points.size() < least) {
    throw std::invalid_argument(std::to_string(cloud.points.size()) + " points; a fit takes at least " + std::to_string(least));
  }
  for (const Vector3& x : cloud.points) {
    if (!x.allFinite()) throw std::invalid_argument("a coordinate is not finite");
  }
  // Half-axes are valid from 1e-30 to 1e30. This leaves a margin for bodies larger or thinner than the data.
  constexpr double kLeast = 1e-25, kLargest = 1e25;
  Vector3 low = cloud.points.front(), high = low;
  for (const Vector3& x : cloud.points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double range = (high - low).maxCoeff();
  const double rounding = std::numeric_limits<double>::epsilon() * low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  if (!(range > 1e4 * rounding))
    throw std::invalid_argument("the points are all in one place, to the rounding of their coordinates");
  if (!(range >= kLeast && range <= kLargest)) {
    std::ostringstream text;
    text << "the points extend over " << range << " m; allowed: " << kLeast << " to " << kLargest
         << ". Is the unit right (--unit)?";
    throw std::invalid_argument(text.str());
  }
  const Extent extent = extent_of(cloud.points);
  require_three_dimensions(normalized(cloud, extent));
}

std::vector<std::size_t> gross_outliers(const Cloud& cloud, const FitSettings& settings, bool is_union) {
  if (!settings.rejects_outliers) return {};
  // More points beyond a gap are a separately scanned part of the surface. In a union, as many points as one body needs may be a
  // body.
  const std::size_t most = cloud.points.size() / 5;
  const std::size_t fewest_of_body = least_points(settings.family.value_or(Family::Ellipsoid));
  std::vector<std::size_t> outliers = cut_off(cloud.points, is_union ? std::min(most, fewest_of_body - 1) : most);
  const std::vector<std::size_t> single = isolated(cloud.points);
  outliers.insert(outliers.end(), single.begin(), single.end());
  std::ranges::sort(outliers);
  outliers.erase(std::unique(outliers.begin(), outliers.end()), outliers.end());
  return outliers;
}

std::vector<Body> bodies_of(std::span<const FittedBody> fitted) {
  std::vector<Body> bodies(fitted.size());
  std::ranges::transform(fitted, bodies.begin(), &FittedBody::body);
  return bodies;
}

std::vector<std::size_t> outliers_of(std::span<const FittedBody> fitted) {
  std::vector<std::size_t> outliers;
  for (const FittedBody& each : fitted) outliers.insert(outliers.end(), each.outliers.begin(), each.outliers.end());
  return outliers;
}

void add_gross_outliers(std::vector<FittedBody>& fitted, std::span<const std::size_t> gross, std::size_t points) {
  if (gross.empty()) return;
  const std::vector<std::size_t> kept = others_than(gross, points);
  for (FittedBody& each : fitted) {
    for (std::size_t& outlier : each.outliers) outlier = kept[outlier];
  }
  std::vector<std::size_t>& first = fitted.front().outliers;
  first.insert(first.end(), gross.begin(), gross.end());
  std::ranges::sort(first);
}

Candidate search_body(const Cloud& cloud, Family family, const FitSettings& settings) {
  return best_descent(make_starts(thinned(cloud, 800), family, settings.is_whole), cloud, settings);
}

FitSettings moved(const FitSettings& settings, double scale, const Vector3& offset) {
  FitSettings result = settings;
  result.empty = moved(settings.empty, scale, offset);
  if (settings.volume) result.volume = {settings.volume->volume * std::pow(scale, 3), settings.volume->area * scale * scale};
  return result;
}

FittedBody refine_body(const Body& start, const Cloud& cloud, const FitSettings& settings) {
  require_points(cloud, least_points(start.family));
  const Extent extent = extent_of(cloud.points);
  const Cloud data = normalized(cloud, extent);
  const Vector3 offset = -extent.centre / extent.size;
  const Body body = moved(start, 1 / extent.size, offset);
  return finish(descend_on_all({body, 0}, data, moved(settings, 1 / extent.size, offset), 4), extent, data, settings);
}

FittedBody fit_body(const Cloud& cloud, const FitSettings& settings) {
  const std::vector<std::size_t> gross = gross_outliers(cloud, settings, false);
  std::vector<FittedBody> fitted = {fit_kept(without(cloud, gross), settings)};
  add_gross_outliers(fitted, gross, cloud.points.size());
  return fitted.front();
}

}  // namespace fit
