#include "table.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace fit {
namespace {

using Vector = Eigen::Vector3d;

constexpr std::size_t kPoints = 2000;  // for the search
constexpr int kTrials = 400;  // a table of 15 % is missed with a probability of (1 - 0.15^3)^400 = 0.26, one of 40 % with 1e-11
constexpr double kThickness = 0.01;  // relative to the extent of the points: noise and warp of a table
constexpr double kLeastShare = 0.15;
constexpr double kLeastBeyond = 0.2;  // of the table's points, around the object
constexpr double kMostBelow = 0.02;   // of the object's points, outliers below the table

struct Plane {
  Vector normal = Vector::UnitZ();
  double offset = 0, thickness = 0;

  double height(const Vector& x) const { return normal.dot(x) - offset; }
  bool contains(const Vector& x) const { return std::abs(height(x)) <= thickness; }
};

/// The plane through the points of a plane, by least squares.
Plane refined(const Plane& plane, std::span<const Vector> points) {
  std::vector<Vector> own;
  std::ranges::copy_if(points, std::back_inserter(own), [&](const Vector& x) { return plane.contains(x); });
  const Vector centre = extent_of(own).centre;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector& x : own) scatter += (x - centre) * (x - centre).transpose();
  Plane result = plane;
  result.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  result.offset = result.normal.dot(centre);
  return result;
}

/// Whether the plane is a table under the other points.
bool is_table(const Plane& plane, std::span<const Vector> points) {
  std::vector<Vector> object, table;
  std::size_t above = 0;
  for (const Vector& x : points) {
    const double height = plane.height(x);
    (std::abs(height) <= plane.thickness ? table : object).emplace_back(x - height * plane.normal);
    if (height > plane.thickness) ++above;
  }
  const auto all = static_cast<double>(points.size());
  if (static_cast<double>(table.size()) < kLeastShare * all || static_cast<double>(object.size()) < kLeastShare * all) return false;
  const double share = static_cast<double>(above) / static_cast<double>(object.size());
  if (std::min(share, 1 - share) > kMostBelow) return false;
  const Vector centre = extent_of(object).centre;
  const double radius = radius_of(object);
  const auto beyond = std::ranges::count_if(table, [&](const Vector& x) { return (x - centre).norm() > 1.05 * radius; });
  return static_cast<double>(beyond) >= kLeastBeyond * static_cast<double>(table.size());
}

std::optional<Plane> find_table(std::span<const Vector> points) {
  const double thickness = kThickness * extent_of(points).size;
  std::mt19937_64 random(1);
  std::optional<Plane> best;
  std::ptrdiff_t most = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::array<Vector, 3> corners;
    for (Vector& corner : corners) corner = points[random() % points.size()];
    const Vector normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (!(normal.norm() > thickness * thickness)) continue;
    Plane plane{normal.normalized(), 0, thickness};
    plane.offset = plane.normal.dot(corners[0]);
    const auto count = std::ranges::count_if(points, [&](const Vector& x) { return plane.contains(x); });
    if (count <= most || static_cast<double>(count) < kLeastShare * static_cast<double>(points.size())) continue;
    plane = refined(plane, points);
    if (!is_table(plane, points)) continue;
    best = plane;
    most = count;
  }
  return best;
}

}  // namespace

std::string remove_table(Data& data) {
  const bool is_mesh = !data.triangles.empty();
  const Cloud some = is_mesh ? sample_triangles(data.vertices.points, data.triangles, kPoints, 3) : thinned(data.vertices, kPoints);
  const bool is_usable =
      some.points.size() >= 30 && std::ranges::all_of(some.points, [](const Vector& x) { return x.allFinite(); });
  const std::optional<Plane> table = is_usable ? find_table(some.points) : std::nullopt;
  if (!table) return "";
  // The noise of a table has tails.
  Plane thick = *table;
  thick.thickness *= 2;
  if (is_mesh) {
    const auto is_on_table = [&](const Triangle& t) {
      return std::ranges::all_of(t, [&](std::uint32_t corner) { return thick.contains(data.vertices.points[corner]); });
    };
    const std::size_t removed = std::erase_if(data.triangles, is_on_table);
    remove_stray_vertices(data);
    return std::to_string(removed) + " triangles of a plane under the object are left out (--table keep: they are not)";
  }
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < data.vertices.points.size(); ++i) {
    if (!thick.contains(data.vertices.points[i])) kept.push_back(i);
  }
  const std::size_t removed = data.vertices.points.size() - kept.size();
  data.vertices = selected(data.vertices, kept);
  return std::to_string(removed) + " points of a plane under the object are left out (--table keep: they are not)";
}

}  // namespace fit
