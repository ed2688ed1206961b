#include "fit_union.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "cloud.hpp"
#include "fit_error.hpp"
#include "least_squares.hpp"

namespace fit {

namespace {

// The lengths below are for data of extent 1.
constexpr double kLoss = 0.02;  // loss width while points still change owners

// The excess beyond which empty space costs steeply: the reach is a largest value. Other bodies can take what one has to leave.
constexpr double kSteep = 0.03;

// Required decrease of the root mean square by a further body. Descents from other clusters differ by some per cent.
constexpr double kLeastGain = 0.05;

// The other bodies hide some of a body's surface. But a protrusion from the data is not part of the union.
constexpr double kLargestOverRadius = kLargestOverRadiusOfWhole;

/// Of the search for a body of a part of the data.
FitSettings search_settings(const FitSettings& search, const Extent& part) {
  FitSettings settings;
  settings.largest_over_radius = kLargestOverRadius;
  settings.empty = search.empty;
  settings.limits = search.limits;
  return moved(settings, 1 / part.size, -part.centre / part.size);
}

enum class Distance {
  Surface,  ///< from the nearest surface: the grouping of points is still unknown
  Union,    ///< from the union
};

struct Assignment {
  std::vector<int> owner;           // per point
  std::vector<double> distances;    // per point, from its owner
  std::vector<std::size_t> counts;  // number of points of each body
};

Assignment assign(const std::vector<Body>& bodies, const Cloud& cloud, Distance distance) {
  const std::vector<DistanceFunction> functions(bodies.begin(), bodies.end());
  Assignment result;
  result.counts.assign(bodies.size(), 0);
  for (const Vector3& x : cloud.points) {
    double least = std::numeric_limits<double>::infinity(), chosen = 0;
    int owner = 0;
    for (std::size_t k = 0; k < functions.size(); ++k) {
      const std::optional<Witness> witness = functions[k].find(x);
      if (!witness) continue;
      const double key = distance == Distance::Surface ? std::abs(witness->distance) : witness->distance;
      if (!(key < least)) continue;
      least = key;
      chosen = witness->distance;
      owner = static_cast<int>(k);
    }
    result.owner.push_back(owner);
    result.distances.push_back(chosen);
    ++result.counts[static_cast<std::size_t>(owner)];
  }
  return result;
}

std::vector<std::size_t> indices_of(const std::vector<int>& owner, std::size_t body) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] == static_cast<int>(body)) indices.push_back(i);
  }
  return indices;
}

Cloud owned(const Cloud& cloud, const std::vector<int>& owner, std::size_t body) {
  return selected(cloud, indices_of(owner, body));
}

/// The mean Huber loss of the points, as a mean square.
double mean_loss(const std::vector<double>& distances) {
  double sum = 0;
  for (const double distance : distances) {
    const double size = std::abs(distance);
    sum += size <= kLoss ? size * size : kLoss * (2 * size - kLoss);
  }
  return sum / static_cast<double>(distances.size());
}

/// A set of bodies and its mean square.
struct Model {
  std::vector<Body> bodies;
  double mean_square = std::numeric_limits<double>::infinity();
};

/// Whether one of the models has nearly the same error: descents that end alike.
bool is_known(const Model& model, const std::vector<Model>& models) {
  constexpr double kAlike = 0.01;
  return std::ranges::any_of(models,
                             [&](const Model& other) { return std::abs(model.mean_square / other.mean_square - 1) < kAlike; });
}

bool has_enough(const Assignment& assignment, Family family) {
  return std::ranges::all_of(assignment.counts, [&](std::size_t count) { return count >= 2 * least_points(family); });
}

/// Alternates until no point changes its owner. A model that loses a body gets an infinite mean square.
Model alternate(std::vector<Body> bodies, const Cloud& cloud, const FitSettings& search, Distance distance, int rounds) {
  LeastSquaresSettings settings;
  settings.empty = search.empty;
  settings.limits = search.limits;
  settings.loss_width = kLoss;
  settings.max_iterations = 8;
  settings.tolerance = 1e-5;
  Assignment assignment = assign(bodies, cloud, distance);
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      if (!has_enough(assignment, bodies[k].family)) return {};
      const Cloud part = owned(cloud, assignment.owner, k);
      settings.largest_half_axis = kLargestOverRadius * radius_of(part.points);
      bodies[k] = minimize_distances(bodies[k], part.points, {}, settings).body;
    }
    const std::vector<int> before = std::move(assignment.owner);
    assignment = assign(bodies, cloud, distance);
    if (assignment.owner == before) break;
  }
  if (distance == Distance::Surface) assignment = assign(bodies, cloud, Distance::Union);
  double penalty = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    // In the cost of a body, the penalty counts as often as the body has points.
    penalty +=
        penalty_of(bodies[k], search.empty) * static_cast<double>(assignment.counts[k]) / static_cast<double>(cloud.points.size());
  }
  return {bodies, mean_loss(assignment.distances) + penalty};
}

/// The best ellipsoid of a part of the data, or none.
std::optional<Body> find_ellipsoid(const Cloud& part, const FitSettings& search) {
  if (part.points.size() < 2 * least_points(Family::Ellipsoid)) return std::nullopt;
  // Normalize by the extent of the part: the search expects data of size 1.
  const Extent extent = extent_of(part.points);
  const Candidate found = search_body(normalized(part, extent), Family::Ellipsoid, search_settings(search, extent));
  if (!std::isfinite(found.mean_square)) return std::nullopt;
  return moved(found.body, extent.size, extent.centre);
}

/// Ellipsoids from k-means clusters.
Model start_from_clusters(const Cloud& cloud, const FitSettings& search, int count, std::uint64_t seed) {
  const std::vector<int> cluster = find_clusters(cloud.points, count, seed);
  std::vector<Body> bodies;
  for (int k = 0; k < count; ++k) {
    const std::optional<Body> found = find_ellipsoid(owned(cloud, cluster, static_cast<std::size_t>(k)), search);
    if (!found) return {};
    bodies.push_back(*found);
  }
  const Model model = alternate(bodies, cloud, search, Distance::Surface, 8);
  return std::isfinite(model.mean_square) ? alternate(model.bodies, cloud, search, Distance::Union, 8) : model;
}

/// Converts an ellipsoid to another family, on its own points, with the best of its three axes as z.
Body promoted(const Body& ellipsoid, const Cloud& points, const FitSettings& search, Family family) {
  LeastSquaresSettings settings;
  settings.empty = search.empty;
  settings.limits = search.limits;
  settings.loss_width = kLoss;
  settings.largest_half_axis = kLargestOverRadius * radius_of(points.points);
  settings.max_iterations = 15;
  settings.tolerance = 1e-4;
  Matrix3 cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  LeastSquaresResult best;
  Body start = ellipsoid;
  start.family = family;
  best.body = start;
  for (int turn = 0; turn < 3; ++turn, start = with_axes(start, cycle)) {
    const LeastSquaresResult result = minimize_distances(start, points.points, {}, settings);
    if (result.cost < best.cost) best = result;
  }
  return best.body;
}

/// Converts the ellipsoids of a model and repeats the alternation.
Model with_family(const Model& model, const Cloud& cloud, const FitSettings& search, Family family) {
  if (family == Family::Ellipsoid || !std::isfinite(model.mean_square)) return model;
  const Assignment assignment = assign(model.bodies, cloud, Distance::Union);
  if (!has_enough(assignment, family)) return {};
  std::vector<Body> bodies;
  for (std::size_t k = 0; k < model.bodies.size(); ++k) {
    const Body& body = model.bodies[k];
    bodies.push_back(body.family == family ? body : promoted(body, owned(cloud, assignment.owner, k), search, family));
  }
  return alternate(bodies, cloud, search, Distance::Union, 20);
}

/// Whether the distances of a body's points look like noise.
bool is_well_fitted(const Body& body, const Cloud& part) {
  const DistanceFunction function(body);
  std::vector<Witness> witnesses;
  std::vector<double> distances;
  for (const Vector3& x : part.points) {
    const std::optional<Witness> witness = function.find(x);
    if (!witness) return false;
    witnesses.push_back(*witness);
    distances.push_back(witness->distance);
  }
  return !find_uncertainty(body, witnesses, distances).is_significant;
}

/// Searches again for each body that does not fit its own points. Keeps the results that improve the model. The descent from an
/// ellipsoid may have ended in a local minimum.
Model searched_again(Model model, const Cloud& cloud, const FitSettings& search, Family family) {
  for (std::size_t k = 0; k < model.bodies.size(); ++k) {
    const Cloud part = owned(cloud, assign(model.bodies, cloud, Distance::Union).owner, k);
    if (part.points.size() < 2 * least_points(family) || is_well_fitted(model.bodies[k], part)) continue;
    const Extent extent = extent_of(part.points);
    const Candidate found = search_body(normalized(part, extent), family, search_settings(search, extent));
    if (!std::isfinite(found.mean_square)) continue;
    std::vector<Body> bodies = model.bodies;
    bodies[k] = moved(found.body, extent.size, extent.centre);
    const Model other = alternate(bodies, cloud, search, Distance::Union, 20);
    if (other.mean_square < model.mean_square) model = other;
  }
  return model;
}

double resolved_square(const Model& model) { return model.mean_square + kSharpestEdge * kSharpestEdge; }

double criterion(const Model& model, std::size_t points) {
  const auto n = static_cast<double>(points);
  double numbers = 0;
  for (const Body& body : model.bodies) numbers += parameter_count(body.family);
  return n * std::log(resolved_square(model)) + numbers * std::log(n);
}

/// Whether the root mean square is smaller by the required decrease.
bool gains(const Model& model, const Model& other) {
  return std::isfinite(model.mean_square) &&
         std::sqrt(resolved_square(model)) < (1 - kLeastGain) * std::sqrt(resolved_square(other));
}

/// Whether a model justifies its additional bodies.
bool is_better(const Model& more, const Model& fewer, std::size_t points) {
  if (!std::isfinite(more.mean_square)) return false;
  if (!std::isfinite(fewer.mean_square)) return true;
  return criterion(more, points) < criterion(fewer, points) && gains(more, fewer);
}

/// One body from all starts of a single fit. So a second body is never taken because of a poor first one.
Model best_of_one(const Cloud& cloud, Family family, const FitSettings& settings) {
  const Extent extent = extent_of(cloud.points);
  const Candidate found =
      search_body(normalized(cloud, extent), family, moved(settings, 1 / extent.size, -extent.centre / extent.size));
  if (!std::isfinite(found.mean_square)) return {};
  const std::vector<Body> bodies = {moved(found.body, extent.size, extent.centre)};
  return {bodies, mean_loss(assign(bodies, cloud, Distance::Union).distances) + penalty_of(bodies.front(), settings.empty)};
}

/// Sets with one more body than a model: an ellipsoid for each cluster of points outside the union, or two for the points of a body
/// that fits badly.
std::vector<std::vector<Body>> enlarged(const Model& model, const Cloud& cloud, const FitSettings& search) {
  constexpr int kClusters = 4;            // of the points outside
  constexpr std::size_t kMostHalved = 2;  // bodies
  std::vector<std::vector<Body>> sets;
  const Assignment assignment = assign(model.bodies, cloud, Distance::Union);
  const double outside = std::sqrt(mean_loss(assignment.distances));
  std::vector<std::size_t> far;
  std::vector<double> losses(model.bodies.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const double distance = assignment.distances[i];
    if (distance > outside) far.push_back(i);
    losses[static_cast<std::size_t>(assignment.owner[i])] += distance * distance;
  }
  const Cloud beyond = selected(cloud, far);
  if (far.size() >= static_cast<std::size_t>(kClusters)) {
    const std::vector<int> cluster = find_clusters(beyond.points, kClusters, 1);
    for (std::size_t k = 0; k < static_cast<std::size_t>(kClusters); ++k) {
      const std::optional<Body> more = find_ellipsoid(owned(beyond, cluster, k), search);
      if (!more) continue;
      sets.push_back(model.bodies);
      sets.back().push_back(*more);
    }
  }
  for (std::size_t turn = 0; turn < std::min(kMostHalved, losses.size()); ++turn) {
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(losses) - losses.begin());
    losses[worst] = -1;
    const Cloud part = owned(cloud, assignment.owner, worst);
    if (part.points.size() < 2) continue;
    const std::vector<int> half = find_clusters(part.points, 2, 1);
    const std::optional<Body> first = find_ellipsoid(owned(part, half, 0), search),
                              second = find_ellipsoid(owned(part, half, 1), search);
    if (!first || !second) continue;
    sets.push_back(model.bodies);
    sets.back()[worst] = *first;
    sets.back().push_back(*second);
  }
  return sets;
}

/// The models from several clusterings. Clusterings with the same ellipsoids are used once.
std::vector<Model> from_clusterings(const Cloud& cloud, const FitSettings& search, int count, Family family) {
  constexpr int kSeeds = 2;
  std::vector<Model> starts, models;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Model start = start_from_clusters(cloud, search, count, static_cast<std::uint64_t>(seed));
    if (!std::isfinite(start.mean_square) || is_known(start, starts)) continue;
    starts.push_back(start);
    models.push_back(with_family(start, cloud, search, family));
  }
  return models;
}

/// The models with one more body than `fewer`.
std::vector<Model> enlargements(const Model& fewer, const Cloud& cloud, const FitSettings& search, Family family) {
  std::vector<Model> models;
  if (!std::isfinite(fewer.mean_square)) return models;
  for (const std::vector<Body>& bodies : enlarged(fewer, cloud, search))
    models.push_back(with_family(alternate(bodies, cloud, search, Distance::Union, 8), cloud, search, family));
  return models;
}

/// The model without the body that the others replace best.
Model reduced(const Model& model, const Cloud& cloud, const FitSettings& search) {
  std::vector<Body> kept;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < model.bodies.size(); ++k) {
    std::vector<Body> others = model.bodies;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    const double loss = mean_loss(assign(others, cloud, Distance::Union).distances);
    if (!(loss < least)) continue;
    least = loss;
    kept = others;
  }
  return alternate(kept, cloud, search, Distance::Union, 8);
}

/// Models with `count` bodies, the best first: from clusterings, and from the best model `fewer` with one body less. Bodies that
/// the others replace move to where they are missed (split and merge; Ueda et al., Neural Computation 12, 2000).
std::vector<Model> models_of_count(const Model& fewer, const Cloud& cloud, const FitSettings& search, int count, Family family) {
  std::vector<Model> models = from_clusterings(cloud, search, count, family);
  models.emplace_back();  // with an infinite error: the last
  Model best, before;
  const auto add = [&](const std::vector<Model>& more) {
    models.insert(models.end(), more.begin(), more.end());
    std::ranges::stable_sort(models, {}, &Model::mean_square);
    before = std::exchange(best, models.front());
  };
  add(enlargements(fewer, cloud, search, family));
  while (gains(best, before)) add(enlargements(reduced(best, cloud, search), cloud, search, family));
  return models;
}

/// The final descents, on all points and with error bars.
std::vector<FittedBody> finish(std::vector<Body> bodies, const Cloud& cloud, FitSettings settings) {
  const std::optional<VolumeTarget> whole = settings.volume;
  constexpr int kRounds = 4;
  std::vector<FittedBody> fitted(bodies.size());
  std::vector<int> before;
  for (int round = 0; round < kRounds; ++round) {
    const Assignment assignment = assign(bodies, cloud, Distance::Union);
    if (assignment.owner == before) break;
    const double missing = whole ? whole->volume - integrate_union(bodies).solid.volume : 0;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const std::vector<std::size_t> indices = indices_of(assignment.owner, k);
      if (whole) {
        // A body grows by its share of the missing volume on its share of the surface.
        const double share = static_cast<double>(indices.size()) / static_cast<double>(cloud.points.size());
        settings.volume = {make_shape(bodies[k])->mass_properties().volume + share * missing, share * whole->area};
      }
      fitted[k] = refine_body(bodies[k], selected(cloud, indices), settings);
      for (std::size_t& outlier : fitted[k].outliers) outlier = indices[outlier];
      bodies[k] = fitted[k].body;
    }
    before = assignment.owner;
  }
  for (FittedBody& each : fitted) each.body = in_customary_order(each.body);
  return fitted;
}

/// Whether each body fits its points within the noise. Then the data bound the union, as in fit_body().
bool are_well_fitted(const std::vector<FittedBody>& fitted, double size) {
  return std::ranges::all_of(fitted, [&](const FittedBody& each) { return is_within_noise(each.uncertainty, size); });
}

/// The union without the bounds of the empty space, if it then fits within the noise. Half of a body's surface determines the rest,
/// but which points are a body's is known only after the search, which no body without bounds would survive.
std::optional<std::vector<FittedBody>> released(const Union& found, const Cloud& cloud, FitSettings settings) {
  const Extent extent = extent_of(cloud.points);
  settings.empty = {};
  std::vector<Body> bodies = bodies_of(found.bodies);
  for (Body& body : bodies) body = moved(body, 1 / extent.size, -extent.centre / extent.size);
  const Cloud some = thinned(normalized(cloud, extent), 3000);
  bodies = alternate(bodies, some, moved(settings, 1 / extent.size, -extent.centre / extent.size), Distance::Union, 20).bodies;
  if (bodies.empty()) return std::nullopt;
  for (Body& body : bodies) body = moved(body, extent.size, extent.centre);
  std::vector<FittedBody> fitted = finish(bodies, cloud, settings);
  return are_well_fitted(fitted, extent.size) ? std::optional(fitted) : std::nullopt;
}

std::vector<FittedBody> unite(const Cloud& cloud, int largest_count, const FitSettings& settings, const Progress& progress) {
  require_points(cloud, least_points(settings.family.value_or(Family::Ellipsoid)));
  const Extent extent = extent_of(cloud.points);
  const Cloud data = normalized(cloud, extent), few = thinned(data, 1000);
  const Family family = settings.family.value_or(Family::Superellipsoid);
  FitSettings of_data = moved(settings, 1 / extent.size, -extent.centre / extent.size);
  // What one body fits needs no bounds, as in fit_body().
  const Model one = best_of_one(few, family, of_data);
  const bool fits = std::isfinite(one.mean_square) &&
                    (one.mean_square < kSharpestEdge * kSharpestEdge || is_well_fitted(one.bodies.front(), few));
  if (settings.sides == Sides::All || (settings.sides == Sides::Auto && !fits))
    of_data.empty = find_empty_space(settings.surface.points.empty() ? data : normalized(settings.surface, extent));
  of_data.empty.steep = kSteep;

  std::vector<Model> best, of_count;
  for (int count = 1; count <= largest_count; ++count) {
    if (progress) progress(count, largest_count);
    of_count = count == 1 ? std::vector{best_of_one(few, family, of_data)}
                          : models_of_count(of_count.front(), few, of_data, count, family);
    if (best.empty() || is_better(of_count.front(), best.front(), few.points.size())) best = of_count;
  }
  if (best.front().bodies.size() <= 1) return {fit_body(cloud, settings)};
  FitSettings of_part = moved(of_data, extent.size, extent.centre);
  of_part.is_whole = false;  // the others hide some of it
  of_part.largest_over_radius = kLargestOverRadius;
  const Cloud some = thinned(data, 3000);
  // The search ranks unions by the mean square and the penalty. Their ranks among near equals say nothing of the limits.
  constexpr std::size_t kMostUnions = 4;  // the hand and the elephant of constants.md take 3
  std::vector<Model> tried;
  Union nearest;
  for (const Model& model : best) {
    if (is_known(model, tried)) continue;
    if (tried.size() == kMostUnions || !std::isfinite(model.mean_square)) break;
    tried.push_back(model);
    if (settings.progress) settings.progress("descending with " + std::to_string(model.bodies.size()) + " bodies on all points");
    std::vector<Body> bodies = searched_again(model, some, of_data, family).bodies;
    for (Body& body : bodies) body = moved(body, extent.size, extent.centre);
    const Union other = bounded(finish(bodies, cloud, of_part), cloud, of_part);
    if (tried.size() == 1 || other.excess < nearest.excess) nearest = other;
    if (nearest.excess.is_within()) break;
  }
  const bool may_be_hidden = settings.sides == Sides::Auto && of_part.empty.grid && !settings.is_whole;
  return may_be_hidden ? released(nearest, cloud, of_part).value_or(nearest.bodies) : nearest.bodies;
}

}  // namespace

Union bounded(std::vector<FittedBody> fitted, const Cloud& cloud, FitSettings settings) {
  constexpr int kMostRounds = 8;                       // constants.md has examples
  constexpr double kBoundWeight = 100 * kEmptyWeight;  // constants.md has others
  const double size = 1 / settings.empty.scale;        // of the data: the grid is for extent 1
  if (!settings.empty.grid || are_well_fitted(fitted, size)) return {fitted, {}};
  const auto error_of = [&](const std::vector<FittedBody>& each) {
    return find_distances(bodies_of(each),
                          settings.mesh.triangles.empty() ? Data{without(cloud, outliers_of(each)), {}, ""} : settings.mesh);
  };
  FitError error = error_of(fitted);
  const double most = std::max(kMostReach * error.radius, settings.empty.margin * size);
  Excess least(error, most);
  std::vector<Body> bodies = bodies_of(fitted);
  double bound = most;
  settings.empty.is_fine = true;
  settings.empty.weight = kBoundWeight;
  for (int round = 0; round < kMostRounds && !least.is_within(); ++round) {
    if (settings.progress && round == 0) settings.progress("descending with a bound on the reach beyond the data");
    if (round > 0) bound -= std::max(0.0, error.reach - most);  // the first descent leaves what the search did
    if (!(bound > 0)) break;
    settings.empty.margin = bound / size;
    const std::vector<FittedBody> next = finish(bodies, cloud, settings);
    bodies = bodies_of(next);
    error = error_of(next);
    const Excess excess(error, most);
    if (excess < least) {
      least = excess;
      fitted = next;
    }
  }
  return {fitted, least};
}

std::vector<FittedBody> fit_union(const Cloud& cloud, int largest_count, const FitSettings& settings, const Progress& progress) {
  constexpr int kLargestCount = 16;
  if (largest_count < 1 || largest_count > kLargestCount) {
    throw std::invalid_argument("at most " + std::to_string(largest_count) + " bodies; allowed: 1 to " +
                                std::to_string(kLargestCount));
  }
  if (largest_count == 1) return {fit_body(cloud, settings)};
  const std::vector<std::size_t> gross = gross_outliers(cloud, settings, true);
  std::vector<FittedBody> fitted = unite(without(cloud, gross), largest_count, settings, progress);
  add_gross_outliers(fitted, gross, cloud.points.size());
  return fitted;
}

}  // namespace fit
