// Volume integrals of a hull, also when it is swept by a sphere: sums over its surface triangles.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "shapes/convex_hull.hpp"
#include "shapes/mass_properties.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal {
namespace {

/// m; the vertices of a triangle, counter-clockwise seen from outside, relative to the middle.
using Triangle = std::array<Vector3, 3>;

/// An edge between two triangles, along the boundary of the first.
struct Edge {
  std::size_t triangle, neighbour;
  std::size_t start;  // of the vertex of the first triangle
};

/// The surface of a hull.
struct HullSurface {
  std::vector<Triangle> triangles;
  std::vector<std::array<std::size_t, 3>> corners;  // of the triangles: indices of vertices
  std::vector<Edge> edges;
};

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
HullSurface surface_of(std::span<const Vector3> points, const Bounds& bounds) {
  std::map<LatticePoint, Vector3> places;
  std::vector<LatticePoint> lattice;
  for (const Vector3& point : points) {
    LatticePoint& place = lattice.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      const double half = bounds.half[axis];
      const double relative = half > 0 ? (point[axis] - bounds.middle[axis]) / half : 0;
      place[static_cast<std::size_t>(axis)] = std::llround(relative * static_cast<double>(kLatticeHalfWidth - 1));
    }
    places.try_emplace(place, point - bounds.middle);
  }
  ConvexHull hull;
  hull.build(lattice);
  HullSurface surface;
  std::map<const ConvexHull::Face*, std::size_t> known;
  hull.for_each_face([&](const ConvexHull::Face& face) {
    known[&face] = surface.triangles.size();
    surface.corners.push_back(face.vertices);
    Triangle& triangle = surface.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = places.at(hull.points()[face.vertices[k]]);
  });
  for (const auto& [face, triangle] : known) {
    for (std::size_t k = 0; k < 3; ++k) {  // each edge once: the triangle beyond it has it the other way round
      if (face->vertices[k] > face->vertices[(k + 1) % 3]) continue;
      surface.edges.push_back({triangle, known.at(&hull.face(face->neighbours[k])), k});
    }
  }
  return surface;
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

/// Volume and moments about the middle.
struct HullMoments {
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();

  void add(double v, const Vector3& f, const Matrix3& s) {
    volume += v;
    first += f;
    second += s;
  }
};

Matrix3 both(const Vector3& a, const Vector3& b) { return a * b.transpose() + b * a.transpose(); }

/// The tetrahedron between the middle and a triangle.
void add_core(const Triangle& t, HullMoments& moments) {
  const double v = t[0].dot(t[1].cross(t[2])) / 6;
  const Vector3 sum = t[0] + t[1] + t[2];
  Matrix3 squares = sum * sum.transpose();
  for (const Vector3& vertex : t) squares += vertex * vertex.transpose();
  moments.add(v, v / 4 * sum, v / 20 * squares);
}

/// What a sphere of radius r sweeps over a triangle: a prism.
void add_prism(const Triangle& t, double r, HullMoments& moments) {
  const Vector3 across = area_vector(t);
  const double area = 0.5 * across.norm();
  const Vector3 n = across.stableNormalized(), sum = t[0] + t[1] + t[2];
  Matrix3 squares = sum * sum.transpose();
  for (const Vector3& vertex : t) squares += vertex * vertex.transpose();
  moments.add(area * r, area * r * (sum / 3 + 0.5 * r * n),
              area * r * (squares / 12 + r / 6 * both(sum, n) + r * r / 3 * n * n.transpose()));
}

/// What it sweeps over an edge from a to b: the normals turn by `angle` from n to the one of the neighbour, first towards `out`.
/// The sectors of spheres at its ends add the part along the edge, which their moments about the vertices have in common.
void add_sector(const Vector3& a, const Vector3& b, const Vector3& n, const Vector3& out, double angle, double r,
                HullMoments& moments) {
  const double length = (b - a).norm(), sine = std::sin(angle), squared = 0.5 * r * r;
  const Vector3 middle = 0.5 * (a + b), along = (b - a) / length;
  const Vector3 turned = sine * n + (1 - std::cos(angle)) * out;  // the integral of the normals over the angle
  const double half = 0.5 * angle, quarter = 0.5 * sine * std::cos(angle);
  const Matrix3 squares = (half + quarter) * n * n.transpose() + (half - quarter) * out * out.transpose() +
                          0.5 * sine * sine * both(n, out) + angle * along * along.transpose();
  const Matrix3 line = middle * middle.transpose() + length * length / 12 * along * along.transpose();
  moments.add(length * angle * squared, length * (angle * squared * middle + r * r * r / 3 * turned),
              length * (angle * squared * line + r * r * r / 3 * both(middle, turned) + r * r * squared / 2 * squares));
}

/// The layer by Steiner's formula: prisms on faces, sectors of cylinders on edges, and of spheres on vertices, whose solid angles
/// are what the angles of their faces leave of a whole turn. (Schneider, Convex Bodies, section 4.2.)
void add_layer(const HullSurface& surface, double r, HullMoments& moments) {
  std::map<std::size_t, std::pair<Vector3, double>> vertices;  // place; solid angle
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Triangle& t = surface.triangles[i];
    add_prism(t, r, moments);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 next = t[(k + 1) % 3] - t[k], last = t[(k + 2) % 3] - t[k];
      auto& [place, angle] = vertices.try_emplace(surface.corners[i][k], t[k], 2 * std::numbers::pi).first->second;
      angle -= std::atan2(next.cross(last).norm(), next.dot(last));
    }
  }
  for (const auto& [triangle, neighbour, start] : surface.edges) {
    const Triangle& t = surface.triangles[triangle];
    const Vector3 &a = t[start], &b = t[(start + 1) % 3];
    const Vector3 n = area_vector(t).stableNormalized(), beyond = area_vector(surface.triangles[neighbour]).stableNormalized();
    const Vector3 out = (b - a).cross(n).stableNormalized();
    add_sector(a, b, n, out, std::abs(std::atan2(beyond.dot(out), beyond.dot(n))), r, moments);
  }
  const double third = r * r * r / 3;
  for (const auto& [index, vertex] : vertices) {
    const auto& [place, angle] = vertex;
    moments.add(third * angle, third * angle * place, third * angle * place * place.transpose());
  }
  moments.second += 4 * std::numbers::pi / 15 * r * r * third * 3 * Matrix3::Identity();
}

}  // namespace

MassProperties swept_polytope(std::span<const Vector3> points, double radius) {
  const Bounds bounds(points);
  const HullSurface surface = surface_of(points, bounds);
  HullMoments moments;
  for (const Triangle& triangle : surface.triangles) add_core(triangle, moments);
  if (radius > 0) add_layer(surface, radius, moments);
  const auto& [volume, first, second] = moments;
  if (!(volume > 0)) return {};
  const Vector3& m = bounds.middle;
  MassProperties mass;
  mass.volume = volume;
  mass.centroid = m + first / volume;
  mass.second_moment = second + first * m.transpose() + m * first.transpose() + volume * m * m.transpose();
  // A flat hull has the triangle of its farthest points alone.
  const bool is_whole = surface.triangles.size() > 2 || points.size() == 3;
  mass.relative_error = is_whole ? volume_outside(points, m, surface.triangles) / volume : 1;
  return mass;
}

MassProperties Polytope::mass_properties() const { return swept_polytope(points_, 0); }

}  // namespace supernormal
