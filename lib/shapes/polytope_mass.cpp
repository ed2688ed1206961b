// Volume integrals of a hull: sums over the tetrahedra between its middle and its surface triangles.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "shapes/convex_hull.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

/// m; the vertices of a triangle, counter-clockwise seen from outside, relative to the middle.
using Triangle = std::array<Vector3, 3>;

/// The bounding box of the points. half_extents() does not contain its position.
struct Bounds {
  Vector3 middle, half;

  explicit Bounds(std::span<const Vector3> points) {
    Vector3 low = points.front(), high = low;
    for (const Vector3& point : points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    middle = 0.5 * low + 0.5 * high;
    half = 0.5 * high - 0.5 * low;
  }
};

/// The surface triangles of the hull. The hull of lattice points decides which points form a triangle. The triangles then use the
/// points themselves, so vertices and coplanar faces keep their digits. The lattice is stretched with the body, which does not
/// change the hull.
std::vector<Triangle> surface(std::span<const Vector3> points, const Bounds& bounds) {
  std::map<LatticePoint, Vector3> places;
  std::vector<LatticePoint> lattice;
  for (const Vector3& point : points) {
    LatticePoint& place = lattice.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      const double relative = (point[axis] - bounds.middle[axis]) / bounds.half[axis];
      place[static_cast<std::size_t>(axis)] = std::llround(relative * static_cast<double>(kLatticeHalfWidth - 1));
    }
    places.try_emplace(place, point - bounds.middle);
  }
  ConvexHull hull;
  hull.build(lattice);
  std::vector<Triangle> triangles;
  hull.for_each_face([&](const ConvexHull::Face& face) {
    Triangle& triangle = triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = places.at(hull.points()[face.vertices[k]]);
  });
  return triangles;
}

/// Twice the area, along the outward normal.
Vector3 area_vector(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

/// m^3; a bound on the volume that points outside the triangles may add.
double volume_outside(std::span<const Vector3> points, const Vector3& middle, std::span<const Triangle> triangles) {
  double sum = 0;
  for (const Triangle& triangle : triangles) {
    const Vector3 across = area_vector(triangle);
    double highest = 0;
    for (const Vector3& point : points) highest = std::max(highest, across.dot(point - middle - triangle[0]));
    sum += 0.5 * highest;
  }
  return sum;
}

}  // namespace

MassProperties Polytope::mass_properties() const {
  const Bounds bounds(points_);
  if (!(bounds.half.minCoeff() > 0)) return {};  // the hull is flat along an axis
  const std::vector<Triangle> triangles = surface(points_, bounds);
  double volume = 0;
  Vector3 first = Vector3::Zero();  // moments about the middle
  Matrix3 second = Matrix3::Zero();
  for (const Triangle& t : triangles) {
    const double v = t[0].dot(t[1].cross(t[2])) / 6;
    const Vector3 sum = t[0] + t[1] + t[2];
    volume += v;
    first += v / 4 * sum;
    for (const Vector3& corner : t) second += v / 20 * corner * corner.transpose();
    second += v / 20 * sum * sum.transpose();
  }
  if (!(volume > 0)) return {};
  const Vector3& m = bounds.middle;
  MassProperties mass;
  mass.volume = volume;
  mass.centroid = m + first / volume;
  mass.second_moment = second + first * m.transpose() + m * first.transpose() + volume * m * m.transpose();
  mass.relative_error = volume_outside(points_, m, triangles) / volume;
  return mass;
}

}  // namespace supernormal
