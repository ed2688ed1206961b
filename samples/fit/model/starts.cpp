#include "starts.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>
#include <utility>

namespace fit {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

Eigen::SelfAdjointEigenSolver<Matrix3> principal_axes(const Cloud& cloud) {
  const Extent extent = extent_of(cloud.points);
  Matrix3 moment = Matrix3::Zero();
  for (const Vector3& x : cloud.points) moment += (x - extent.centre) * (x - extent.centre).transpose();
  return Eigen::SelfAdjointEigenSolver<Matrix3>(moment / static_cast<double>(cloud.points.size()));
}

/// The centre of the best sphere. With normals m: x = centre + radius m. Without: |x|^2 - 2 centre.x is the same for all points
/// (Coope 1993). Both are linear least squares.
Vector3 sphere_centre(const Cloud& cloud) {
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  Eigen::Vector4d b = Eigen::Vector4d::Zero();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vector3& x = cloud.points[i];
    if (cloud.normals.empty()) {
      const Eigen::Vector4d row(2 * x.x(), 2 * x.y(), 2 * x.z(), 1);
      A += row * row.transpose();
      b += row * x.squaredNorm();
    } else {
      for (int k = 0; k < 3; ++k) {
        Eigen::Vector4d row = Eigen::Vector4d::Unit(k);
        row[3] = cloud.normals[i][k];
        A += row * row.transpose();
        b += row * x[k];
      }
    }
  }
  return A.completeOrthogonalDecomposition().solve(b).head<3>();
}

/// Rotations from the principal axes to the axes of the starts.
std::vector<Matrix3> make_rotations(const Vector3& moments) {
  const auto about = [](const Vector3& axis, double angle) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); };
  // Each of the three axes becomes z once.
  Matrix3 cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const std::array<Matrix3, 3> permutations = {Matrix3::Identity(), cycle, cycle * cycle};
  std::vector<Matrix3> turns;
  for (const Matrix3& permutation : permutations) {
    turns.push_back(permutation);
    turns.emplace_back(permutation * about(Vector3::UnitZ(), kHalfTurn / 4));
  }
  // Moments are sorted. Axes with similar moments hardly determine the orientation.
  constexpr double kAlike = 0.7;
  const bool first_two = moments[0] > kAlike * moments[1], last_two = moments[1] > kAlike * moments[2];
  std::vector<Matrix3> more;
  if (first_two && last_two) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 10; ++i) {  // uniform over rotations (Shoemake 1992)
      const double u = uniform(random), v = 2 * kHalfTurn * uniform(random), w = 2 * kHalfTurn * uniform(random);
      const double s = std::sqrt(1 - u), t = std::sqrt(u);
      more.push_back(Eigen::Quaterniond(t * std::cos(w), s * std::sin(v), s * std::cos(v), t * std::sin(w)).toRotationMatrix());
    }
  } else if (first_two || last_two) {
    const Vector3 axis = first_two ? Vector3::UnitZ() : Vector3::UnitX();
    for (const double eighths : {1, 3}) more.push_back(about(axis, kHalfTurn * eighths / 8));
    more.push_back(about(axis, kHalfTurn / 4));
  }
  for (const Matrix3& turn : more) {
    for (const Matrix3& permutation : permutations) turns.emplace_back(turn * permutation);
  }
  return turns;
}

/// Half of the range of the points along an axis, and its middle, without the outermost 2 %.
std::pair<double, double> range_along(const Cloud& cloud, const Vector3& axis) {
  std::vector<double> heights;
  for (const Vector3& x : cloud.points) heights.push_back(axis.dot(x));
  const auto quantile = [&](double share) {
    return ranked(heights, static_cast<std::size_t>(share * static_cast<double>(heights.size() - 1)));
  };
  const double low = quantile(0.01), high = quantile(0.99);
  return {(high - low) / 2, (high + low) / 2};
}

/// The body in its box. If the centre of the best sphere is elsewhere, the data may be one-sided. Then also the body about this
/// centre, and the body with its middle on a face of the box.
std::vector<Body> make_places(const Body& boxed, const Vector3& sphere) {
  std::vector<Body> places = {boxed};
  const Matrix3 rotation = boxed.rotation();
  const Vector3 shift = rotation.transpose() * (sphere - boxed.position);
  const double relative = shift.cwiseQuotient(boxed.half_axes).norm();
  if (!(relative > 0.2)) return places;
  if (relative < 4) {
    Body at_sphere = boxed;
    at_sphere.position = sphere;
    at_sphere.half_axes += shift.cwiseAbs();
    places.push_back(at_sphere);
  }
  for (int i = 0; i < 3; ++i) {
    for (const double side : {-1, 1}) {
      Body at_face = boxed;
      at_face.position += side * boxed.half_axes[i] * rotation.col(i);
      at_face.half_axes[i] *= 2;
      places.push_back(at_face);
    }
  }
  return places;
}

/// The box of the points along the body's axes, without the outermost points.
Body boxed_by(const Cloud& cloud, Body body) {
  constexpr double kLeastHalfAxis = 0.02;
  const Matrix3 rotation = body.rotation();
  body.position.setZero();
  for (int i = 0; i < 3; ++i) {
    const auto [half_range, middle] = range_along(cloud, rotation.col(i));
    body.half_axes[i] = std::max(half_range, kLeastHalfAxis);
    body.position += middle * rotation.col(i);
  }
  return body;
}

}  // namespace

std::vector<Body> make_starts(const Cloud& cloud, Family family, bool is_whole) {
  const auto principal = principal_axes(cloud);
  const Vector3 sphere = sphere_centre(cloud);
  constexpr std::array<std::pair<double, double>, 5> kExponents = {{{2, 2}, {1.4, 1.4}, {6, 6}, {2, 6}, {6, 2}}};
  Matrix3 axes = principal.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) *= -1;
  std::vector<Body> starts;
  for (const Matrix3& turn : make_rotations(principal.eigenvalues())) {
    Body body;
    body.family = family;
    body.orientation = Eigen::Quaterniond(axes * turn).normalized();
    const Body boxed = boxed_by(cloud, body);
    const std::vector<Body> places = is_whole ? std::vector{boxed} : make_places(boxed, sphere);
    const std::size_t exponents = family == Family::Ellipsoid ? 1 : kExponents.size();
    for (const Body& place : places) {
      for (std::size_t k = 0; k < exponents; ++k) {
        starts.push_back(place);
        std::tie(starts.back().delta, starts.back().epsilon) = kExponents[k];
      }
    }
  }
  return starts;
}

}  // namespace fit
