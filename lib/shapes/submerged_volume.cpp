#include "supernormal/shapes/submerged_volume.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace supernormal {
namespace {

constexpr int kSubdivisions = 3;  // subdivisions of an octahedron: 8 x 4^3 triangles

using VertexTriple = std::array<int, 3>;

/// A triangulation of the unit sphere; vertices counter-clockwise seen from outside.
struct SphereMesh {
  std::vector<Vector3> points = {Vector3::UnitX(),  -Vector3::UnitX(), Vector3::UnitY(),
                                 -Vector3::UnitY(), Vector3::UnitZ(),  -Vector3::UnitZ()};
  std::vector<VertexTriple> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};

  void subdivide() {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int i, int j) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(i, j), static_cast<int>(points.size()));
      if (is_new) points.push_back((points[static_cast<std::size_t>(i)] + points[static_cast<std::size_t>(j)]).normalized());
      return place->second;
    };
    std::vector<VertexTriple> finer;
    for (const auto& [a, b, c] : triangles) {
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
};

/// Sums tetrahedra with one common vertex, the origin of the points.
struct Tetrahedra {
  double six_volumes = 0;
  Vector3 moment = Vector3::Zero();

  void add(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double six = a.dot(b.cross(c));
    six_volumes += six;
    moment += six * (a + b + c) / 4;
  }
};

/// Adds the part of a triangle with up.x <= 0, a polygon of up to four vertices.
void add_part_below(const std::array<Vector3, 3>& corners, const Vector3& up, Tetrahedra& sum) {
  std::array<Vector3, 4> part;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3& a = corners[k];
    const Vector3& b = corners[(k + 1) % 3];
    const double height_a = up.dot(a);
    const double height_b = up.dot(b);
    if (height_a <= 0) part[count++] = a;
    if ((height_a < 0 && height_b > 0) || (height_a > 0 && height_b < 0)) {
      part[count++] = a + height_a / (height_a - height_b) * (b - a);
    }
  }
  for (std::size_t k = 2; k < count; ++k) sum.add(part[0], part[k - 1], part[k]);
}

}  // namespace

SubmergedVolume::SubmergedVolume(const Shape& shape) {
  const MassProperties properties = shape.mass_properties();
  whole_ = {properties.volume, properties.centroid};
  SphereMesh mesh;
  for (int k = 0; k < kSubdivisions; ++k) mesh.subdivide();
  // The mesh of an ellipsoid is the image of the sphere's mesh.
  const Vector3 extents = shape.half_extents();
  for (const Vector3& m : mesh.points) points_.push_back(shape.point(m.cwiseQuotient(extents).normalized()));
  triangles_ = std::move(mesh.triangles);
  Tetrahedra meshed;
  for (const auto& [a, b, c] : triangles_) meshed.add(corner(a), corner(b), corner(c));
  if (meshed.six_volumes > 0) enlargement_ = 6 * whole_.volume / meshed.six_volumes;
}

Submerged SubmergedVolume::below(const Vector3& up, double level) const {
  const auto [lowest, highest] = std::ranges::minmax(points_, {}, [&](const Vector3& point) { return up.dot(point); });
  if (up.dot(lowest) >= level) return {};
  if (up.dot(highest) <= level) return whole_;
  // With the origin in the waterplane, the waterplane itself adds nothing to the integrals.
  const Vector3 origin = level * up;
  Tetrahedra sum;
  for (const auto& [a, b, c] : triangles_) add_part_below({corner(a) - origin, corner(b) - origin, corner(c) - origin}, up, sum);
  if (sum.six_volumes <= 0) return {};
  return {enlargement_ * sum.six_volumes / 6, origin + sum.moment / sum.six_volumes};
}

}  // namespace supernormal
