#include "scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "input/sampling.hpp"
#include "input/table.hpp"

namespace fit {
namespace {

// A few vertices lie on many bodies: those of a box on an ellipsoid.
constexpr std::size_t kFewestVertices = 100;

// Vertices of a tessellated body are nearer to it than to the body that fits its facets, and the facets little farther: in standard
// deviations of that fit.
constexpr double kVertices = 0.1, kFacets = 4;

constexpr std::size_t kSurfacePoints = 50000;  // of a mesh: their spacing is about 1.5 % of its extent

/// The points to fit. For a mesh: random points of its triangles, as many as it has vertices, within bounds.
Cloud points_of(const Data& data, bool uses_vertices) {
  if (data.triangles.empty() || uses_vertices) return data.vertices;
  const std::size_t count = std::clamp<std::size_t>(data.vertices.points.size(), 2000, 20000);
  return sample_triangles(data.vertices.points, data.triangles, count, 1);
}

/// The body near the one that fits the facets of a mesh, if its vertices lie on it. The facets then lie below, and exponents that
/// are fitted to them are off by many standard errors. A body that is sought anew may be far from the facets: all vertices of a
/// cylinder lie on ellipsoids.
std::optional<FittedBody> body_of_vertices(const Scan& scan, const FittedBody& to_facets, const FitSettings& settings) {
  const Cloud& vertices = scan.data.vertices;
  if (scan.data.triangles.empty() || vertices.points.size() < kFewestVertices) return std::nullopt;
  FittedBody found = refine_body(to_facets.body, vertices, settings);
  const double sigma = to_facets.uncertainty.sigma;
  const FitError distances = find_distances(scan, {found});
  // The vertices on the rims of a cylinder leave open what its facets say.
  const auto &by_facets = to_facets.uncertainty.is_determined, &by_vertices = found.uncertainty.is_determined;
  const bool leaves_open =
      std::inner_product(by_facets.begin(), by_facets.end(), by_vertices.begin(), false, std::logical_or<>(), std::greater<>());
  if (leaves_open || found.uncertainty.sigma > kVertices * sigma) return std::nullopt;
  if (distances.rms > std::min(kFacets * sigma, kMostDistance * distances.radius)) return std::nullopt;
  found.is_tessellated = true;
  return found;
}

}  // namespace

Scan read_scan(const std::string& path, const Options& options) {
  Scan scan{path, read_data(path, options.scale, options.group), {}, false, {}, {}};
  Data& data = scan.data;
  const bool is_mesh = !data.triangles.empty();
  const auto remark = [&](const std::string& text) {
    if (!text.empty()) scan.remarks.push_back(text);
  };
  remark(path + ": " + std::to_string(data.vertices.points.size()) + " points, " + std::to_string(data.triangles.size()) +
         " triangles");
  remark(data.note);
  if (options.table == "auto") remark(remove_table(data));
  scan.is_closed = is_closed(data);
  if (is_mesh && !scan.is_closed) {
    scan.open = open_edges(data.triangles);
    remark(describe(scan.open) + "; it has no volume, so its convex hull is compared");
  }
  scan.points = points_of(data, options.uses_vertices);
  return scan;
}

FitSettings settings_of(const Options& options, const Scan& scan) {
  const bool is_mesh = !scan.data.triangles.empty();
  const std::map<std::string, std::optional<Family>> families = {{"auto", std::nullopt},
                                                                 {"ellipsoid", Family::Ellipsoid},
                                                                 {"superellipsoid", Family::Superellipsoid},
                                                                 {"superovoid", Family::Superovoid}};
  FitSettings settings;
  settings.family = families.at(options.shape);
  settings.noise = options.noise == "normal" ? Noise::AlongNormal : Noise::Isotropic;
  // A mesh is the surface itself. A distance from the body means another shape, not an outlier or noise.
  settings.rejects_outliers = options.outliers == "auto" ? !is_mesh : options.outliers == "reject";
  if (is_mesh && options.noise == "auto") settings.noise = Noise::AlongNormal;
  settings.is_whole = scan.is_closed;
  // That of the facets is below the body's, on which the vertices are.
  if (settings.is_whole && !options.uses_vertices) settings.volume = volume_target(scan.data);
  if (is_mesh) settings.mesh = scan.data;
  if (is_mesh) settings.surface = sample_triangles(scan.data.vertices.points, scan.data.triangles, kSurfacePoints, 4);
  const std::map<std::string, Sides> sides = {{"auto", Sides::Auto}, {"all", Sides::All}, {"some", Sides::Some}};
  settings.sides = sides.at(options.sides);
  settings.limits = options.limits;
  settings.threads = options.threads;
  settings.progress = say;
  return settings;
}

std::vector<FittedBody> fit_scan(const Scan& scan, const Options& options) {
  try {
    FitSettings settings = settings_of(options, scan);
    std::vector<FittedBody> fitted = fit_union(scan.points, options.bodies, settings, [](int count, int largest) {
      say("looking for " + std::to_string(count) + " of at most " + std::to_string(largest) + " bodies");
    });
    settings.volume.reset();  // of the facets
    const auto of_vertices = fitted.size() > 1 ? std::nullopt : body_of_vertices(scan, fitted.front(), settings);
    if (!of_vertices) return fitted;
    say("the vertices of the mesh lie on a body, and its facets below: the vertices are fitted");
    return {*of_vertices};
  } catch (const std::invalid_argument& error) {
    throw InputError(scan.path + ": " + error.what());
  }
}

FitError find_error(const Scan& scan, const std::vector<FittedBody>& fitted) {
  Data data = scan.data;
  // The fit of a mesh uses other points than its vertices, so a mesh is unchanged.
  if (data.triangles.empty()) data.vertices = without(data.vertices, outliers_of(fitted));
  FitError error = find_error(bodies_of(fitted), data);
  add_uncertainty(error, fitted);
  return error;
}

FitError find_distances(const Scan& scan, const std::vector<FittedBody>& fitted) {
  std::vector<DistanceFunction> functions;
  functions.reserve(fitted.size());
  for (const FittedBody& each : fitted) functions.emplace_back(each.body);
  const std::vector<Eigen::Vector3d> points = without(scan.points, outliers_of(fitted)).points;
  FitError error;
  error.is_hull = true;
  error.radius = radius_of(points);
  double square = 0;
  for (const Vector3& x : points) {
    const double distance = std::abs(least_distance(functions, x));
    error.to_body = std::max(error.to_body, distance);
    square += distance * distance;
  }
  error.rms = std::sqrt(square / static_cast<double>(points.size()));
  return error;
}

void say(const std::string& step) {
  std::printf("%s\n", step.c_str());
  std::fflush(stdout);
}

}  // namespace fit
