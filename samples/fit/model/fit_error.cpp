#include "fit_error.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <stdexcept>
#include <supernormal/shapes/polytope.hpp>
#include <utility>

#include "empty_space.hpp"
#include "input/triangles.hpp"
#include "point_tree.hpp"

namespace fit {

namespace {

constexpr std::size_t kSamples = 20000;         // points on a surface
constexpr std::size_t kBoundarySamples = 4000;  // of an integral over a surface
constexpr std::size_t kVolumeSamples = 400000;  // points in a volume

Solid about_centroid(double volume, const Vector3& centroid, const Matrix3& second_moment) {
  const Matrix3 moment = second_moment - volume * centroid * centroid.transpose();
  return {volume, centroid, moment.trace() * Matrix3::Identity() - moment};
}

Solid solid_of(const Body& body) {
  const supernormal::MassProperties mass = make_shape(body)->mass_properties();
  Solid solid = about_centroid(mass.volume, mass.centroid, mass.second_moment);
  const Matrix3 R = body.rotation();
  solid.centroid = body.position + R * solid.centroid;
  solid.inertia = R * solid.inertia * R.transpose();
  return solid;
}

bool is_closed(std::span<const Triangle> triangles) {
  const OpenEdges edges = open_edges(triangles);
  return !triangles.empty() && edges.single + edges.other == 0;
}

/// Whether the vertices of a triangle are collinear within single precision.
bool is_flat(const Data& data, const Triangle& t) {
  constexpr double kFlat = 1e-6;  // height over the longest edge
  const Vector3 &a = data.vertices.points[t[0]], &b = data.vertices.points[t[1]], &c = data.vertices.points[t[2]];
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return (b - a).cross(c - a).norm() <= kFlat * longest;
}

/// Sums over the tetrahedra between the triangles and their mean point (Mirtich 1996, in the form of Blow and Binstock 2004).
Solid solid_of_mesh(const Data& data) {
  const Extent extent = extent_of(data.vertices.points);
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (const Triangle& t : data.triangles) {
    Matrix3 A;
    for (int k = 0; k < 3; ++k) A.col(k) = data.vertices.points[t[static_cast<std::size_t>(k)]] - extent.centre;
    const double part = A.determinant() / 6;
    const Vector3 sum = A.rowwise().sum();
    volume += part;
    first += part / 4 * sum;
    second += part / 20 * (A * A.transpose() + sum * sum.transpose());
  }
  Solid solid = about_centroid(volume, first / volume, second);
  solid.centroid += extent.centre;
  return solid;
}

Solid solid_of_hull(const Data& data) {
  const Extent extent = extent_of(data.vertices.points);
  const Cloud cloud = normalized(data.vertices, extent);
  const supernormal::MassProperties mass = supernormal::Polytope(cloud.points).mass_properties();
  const double s = extent.size;
  Solid solid = about_centroid(mass.volume * s * s * s, mass.centroid * s, mass.second_moment * std::pow(s, 5));
  solid.centroid += extent.centre;
  return solid;
}

double triangle_distance(const Data& data, const Triangle& t, const Vector3& x) {
  // Nearest point by Voronoi regions (Ericson, Real-Time Collision Detection, section 5.1.5).
  const Vector3 &a = data.vertices.points[t[0]], &b = data.vertices.points[t[1]], &c = data.vertices.points[t[2]];
  const auto segment = [&](const Vector3& p, const Vector3& q) {
    const double length = (q - p).squaredNorm();
    const double s = length > 0 ? std::clamp((x - p).dot(q - p) / length, 0.0, 1.0) : 0;
    return (x - p - s * (q - p)).norm();
  };
  const Vector3 n = (b - a).cross(c - a);
  const double area = n.squaredNorm();
  if (area > 0) {
    const Vector3 p = x - a;
    const double v = n.dot(p.cross(c - a)) / area, w = n.dot((b - a).cross(p)) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) return std::abs(n.dot(p)) / std::sqrt(area);
  }
  return std::min({segment(a, b), segment(b, c), segment(c, a)});
}

/// Points that lead to the nearest surface of the data: the data points, or for a mesh a grid on every triangle, with its index.
struct Landmarks {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::size_t> triangle_of;
};

Landmarks make_landmarks(const Data& data) {
  if (data.triangles.empty()) return {data.vertices.points, {}};
  constexpr double kSpacing = 0.02;  // relative to the extent
  const double spacing = kSpacing * extent_of(data.vertices.points).size;
  Landmarks landmarks;
  for (std::size_t i = 0; i < data.triangles.size(); ++i) {
    const Triangle& t = data.triangles[i];
    const Vector3 a = data.vertices.points[t[0]], u = data.vertices.points[t[1]] - a, v = data.vertices.points[t[2]] - a;
    const int steps = std::max(
        1, static_cast<int>(std::ceil(std::sqrt(std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()})) / spacing)));
    for (int j = 0; j <= steps; ++j) {
      for (int k = 0; j + k <= steps; ++k) {
        landmarks.points.emplace_back(a + (j * u + k * v) / steps);
        landmarks.triangle_of.push_back(i);
      }
    }
  }
  return landmarks;
}

/// The distance of points from the surface of the data. For a mesh: from the triangles of the nearest landmarks.
class DataDistance {
 public:
  explicit DataDistance(const Data& data) : DataDistance(data, make_landmarks(data)) {}

  double operator()(const Vector3& x) const {
    constexpr std::size_t kNeighbours = 16;
    if (data_.triangles.empty()) return tree_.distance(x);
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : tree_.nearest(x, kNeighbours)) {
      nearest = std::min(nearest, triangle_distance(data_, data_.triangles[triangle_of_[i]], x));
    }
    return nearest;
  }

 private:
  DataDistance(const Data& data, Landmarks landmarks)
      : data_(data), triangle_of_(std::move(landmarks.triangle_of)), tree_(std::move(landmarks.points)) {}

  const Data& data_;
  std::vector<std::size_t> triangle_of_;  // per landmark
  PointTree tree_;
};

/// The distance from discs around the points of a cloud: its surface runs between them, in their tangent planes.
class DiscDistance {
 public:
  /// `surface`: of the cloud; a part of the points has its normals.
  DiscDistance(const std::vector<Vector3>& points, const Surface& surface)
      : surface_(surface),
        spacings_(kSpacings * std::sqrt(static_cast<double>(surface.points.size()) / static_cast<double>(points.size()))),
        points_(points),
        with_normals_(surface.points) {}

  double operator()(const Vector3& x) const {
    constexpr std::size_t kNeighbours = 16;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t i : points_.nearest(x, kNeighbours)) {
      const Vector3 way = x - points_.points()[i];
      const std::uint32_t k = with_normals_.nearest(points_.points()[i], 1).front();
      const double height = surface_.normals[k].dot(way), aside = (way - height * surface_.normals[k]).norm();
      nearest = std::min(nearest, std::hypot(height, std::max(0.0, aside - spacings_ * std::sqrt(surface_.areas[k]))));
    }
    return nearest;
  }

 private:
  const Surface& surface_;
  double spacings_;
  PointTree points_, with_normals_;
};

/// The distances of the bodies' surface from the data.
void measure_surface(std::span<const DistanceFunction> functions, const Data& data, FitError& error) {
  const DataDistance to_data(data);
  const Cloud cloud = data.triangles.empty() ? data.vertices : sample_triangles(data.vertices.points, data.triangles, kSamples, 2);
  const Surface surface = make_surface(cloud);
  error.openness = surface.openness;
  const Extent extent = extent_of(cloud.points);
  std::vector<Vector3> closing = closing_points(normalized(cloud, extent));
  for (Vector3& x : closing) x = extent.centre + extent.size * x;
  const PointTree holes(std::move(closing));
  std::optional<DiscDistance> to_discs;
  if (data.triangles.empty()) to_discs.emplace(cloud.points, surface);
  for (const Vector3& x : free_surface(functions, kSamples)) {
    const double distance = to_data(x);
    error.to_data = std::max(error.to_data, distance);
    double beyond = holes.points().empty() ? distance : std::min(distance, holes.distance(x));
    if (beyond <= error.reach || !is_outside(surface, x)) continue;
    if (to_discs) beyond = std::min(beyond, (*to_discs)(x));
    error.reach = std::max(error.reach, beyond);
  }
}

}  // namespace

bool is_closed(const Data& data) {
  if (is_closed(std::span<const Triangle>(data.triangles))) return true;
  // Degenerate triangles enclose no volume. They may close a gap between long and short edges, or lie on a closed edge.
  std::vector<Triangle> solid = data.triangles;
  std::erase_if(solid, [&](const Triangle& t) { return is_flat(data, t); });
  return solid.size() < data.triangles.size() && is_closed(std::span<const Triangle>(solid));
}

VolumeTarget volume_target(const Data& data) {
  VolumeTarget target{solid_of_mesh(data).volume, 0};
  for (const auto& [a, b, c] : data.triangles) {
    const std::vector<Eigen::Vector3d>& x = data.vertices.points;
    target.area += (x[b] - x[a]).cross(x[c] - x[a]).norm() / 2;
  }
  return target;
}

std::vector<Vector3> free_surface(std::span<const DistanceFunction> functions, std::size_t count) {
  std::vector<Vector3> points;
  for (const DistanceFunction& function : functions) {
    const Matrix3 R = function.body().rotation();
    for (const Eigen::Vector3d& r : sample_boundary(function.shape(), count, 1).points) {
      const Vector3 x = function.body().position + R * r;
      const bool is_covered =
          std::ranges::any_of(functions, [&](const DistanceFunction& other) { return &other != &function && other.contains(x); });
      if (!is_covered) points.push_back(x);
    }
  }
  return points;
}

VolumeIntegral integrate_union(std::span<const Body> bodies) {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  std::vector<DistanceFunction> functions;
  for (const Body& body : bodies) {
    functions.emplace_back(body);
    for (int i = 0; i < 3; ++i) {
      const Vector3 up = Vector3::Unit(i);
      high[i] = std::max(high[i], body.position[i] + functions.back().shape().support(functions.back().to_body(up)));
      low[i] = std::min(low[i], body.position[i] - functions.back().shape().support(functions.back().to_body(-up)));
    }
  }
  std::mt19937_64 random(1);
  const double box = (high - low).prod();
  const Vector3 middle = (low + high) / 2;
  double inside = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (std::size_t i = 0; i < kVolumeSamples; ++i) {
    const Vector3 x = (Vector3(uniform(random), uniform(random), uniform(random)).array() - 0.5).matrix().cwiseProduct(high - low);
    const bool is_inside = std::ranges::any_of(functions, [&](const DistanceFunction& f) { return f.contains(middle + x); });
    if (!is_inside) continue;
    inside += 1;
    first += x;
    second += x * x.transpose();
  }
  const auto all = static_cast<double>(kVolumeSamples);
  const double share = inside / all;
  VolumeIntegral result{about_centroid(box * share, first / inside, box / all * second),
                        box * std::sqrt(share * (1 - share) / all)};
  result.solid.centroid += middle;
  return result;
}

void add_uncertainty(FitError& error, std::span<const FittedBody> fitted) {
  std::vector<DistanceFunction> functions;
  for (const FittedBody& each : fitted) functions.emplace_back(each.body);
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(error.body.inertia);
  Eigen::Vector4d square = Eigen::Vector4d::Zero();  // of the volume and the three moments
  double area = 0;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    const Cloud samples = sample_boundary(functions[k].shape(), kBoundarySamples, 1);
    double sum = 0;
    for (std::size_t i = 0; i < samples.points.size(); ++i) sum += samples.normals[i].dot(samples.points[i]);
    const double each = 3 * functions[k].shape().mass_properties().volume / sum;  // the volume is a third of the integral of h
    Eigen::Matrix<double, 4, kParameters> slopes = Eigen::Matrix<double, 4, kParameters>::Zero();
    for (std::size_t i = 0; i < samples.points.size(); ++i) {
      const Matrix3 R = fitted[k].body.rotation();
      const Vector3 x = fitted[k].body.position + R * samples.points[i];
      const auto covers = [&](const DistanceFunction& other) { return &other != &functions[k] && other.contains(x); };
      if (std::ranges::any_of(functions, covers)) continue;
      const Vector3 arm = principal.eigenvectors().transpose() * (x - error.body.centroid);
      const Eigen::Vector4d f(1, arm.tail<2>().squaredNorm(), arm.squaredNorm() - arm.y() * arm.y(), arm.head<2>().squaredNorm());
      slopes -= each * f * functions[k].gradient({0, R * samples.normals[i], x}).transpose();
      area += each;
    }
    square += (slopes * fitted[k].uncertainty.covariance * slopes.transpose()).diagonal();
  }
  const double volume = error.body.volume, missing = error.is_hull ? area * error.mean : error.data.volume - volume;
  // Of the volume. If a body of the families fits, its other sides follow.
  const double hidden = error.is_hull && std::ranges::any_of(fitted, &FittedBody::is_bounded_by_data) ? error.openness : 0;
  square[0] += missing * missing + error.body_error * error.body_error + std::pow(hidden * volume, 2);
  for (int i = 0; i < 3; ++i) {
    const double moment = principal.eigenvalues()[i];
    // A layer of constant thickness changes the moments by 5/3 of the relative change of the volume.
    const Eigen::SelfAdjointEigenSolver<Matrix3> of_data(error.data.inertia, Eigen::EigenvaluesOnly);
    const double misfit = error.is_hull ? 5.0 / 3 * missing / volume * moment : of_data.eigenvalues()[i] - moment;
    square[1 + i] +=
        misfit * misfit + std::pow(5.0 / 3 * error.body_error / volume * moment, 2) + std::pow(5.0 / 3 * hidden * moment, 2);
  }
  error.volume_error = std::sqrt(square[0]);
  error.moment_errors = square.tail<3>().cwiseSqrt();
}

FitError find_distances(std::span<const Body> bodies, const Data& data) {
  FitError error;
  const std::vector<DistanceFunction> functions(bodies.begin(), bodies.end());
  std::vector<Vector3> points = data.vertices.points;
  if (!data.triangles.empty()) {
    const Cloud more = sample_triangles(data.vertices.points, data.triangles, kSamples, 2);
    points.insert(points.end(), more.points.begin(), more.points.end());
  }
  double square = 0, sum = 0;
  const std::size_t uniform = data.triangles.empty() ? 0 : data.vertices.points.size();  // the first of the uniformly spread points
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double least = least_distance(functions, points[i]);
    if (i >= uniform) sum += least;
    error.to_body = std::max(error.to_body, std::abs(least));
    square += least * least;
  }
  error.rms = std::sqrt(square / static_cast<double>(points.size()));
  error.mean = sum / static_cast<double>(points.size() - uniform);
  error.radius = radius_of(points);
  measure_surface(functions, data, error);
  return error;
}

FitError find_error(std::span<const Body> bodies, const Data& data) {
  FitError error = find_distances(bodies, data);
  error.is_hull = !is_closed(data);
  error.data = error.is_hull ? solid_of_hull(data) : solid_of_mesh(data);
  if (bodies.size() == 1) {
    error.body = solid_of(bodies.front());
  } else {
    const VolumeIntegral integral = integrate_union(bodies);
    error.body = integral.solid;
    error.body_error = integral.volume_error;
  }
  return error;
}

}  // namespace fit
