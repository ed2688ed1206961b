#include "supernormal/shapes/tessellation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/finite.hpp"
#include "base/validation.hpp"

namespace supernormal {
namespace {

using Index = std::uint32_t;

// rad; an edge between nearer normals is not halved any more. The boundary between them bends like a sharp edge.
constexpr double kClosest = 1e-9;

constexpr Index kWhole = ~Index{0};

class Tessellator {
 public:
  Tessellator(const Shape& shape, double chord_error)
      : shape_(shape), chord_error_(chord_error), farthest_((1 + kCallbackPrecision) * shape.bounding_radius()) {}

  Tessellation run() {
    for (const int axis : {0, 1, 2}) {
      add(Vector3::Unit(axis));
      add(-Vector3::Unit(axis));
    }
    for (const Index x : {0U, 1U}) {
      for (const Index y : {2U, 3U}) {
        for (const Index z : {4U, 5U}) {
          const bool is_mirrored = (x + y + z) % 2 == 1;
          mesh_.triangles.push_back(is_mirrored ? Triangle{x, z, y} : Triangle{x, y, z});
        }
      }
    }
    while (halve_edges()) {
    }
    return std::move(mesh_);
  }

 private:
  using Triangle = std::array<Index, 3>;

  Index add(const Vector3& normal) {
    const Vector3 point = shape_.point(normal);
    // Edges to points that are not finite or outside this ball would be halved without end.
    if (!(all_within(point, farthest_) && point.norm() <= farthest_)) {
      throw std::domain_error("a boundary point of the shape is " + to_text(point.norm()) +
                              " m from its origin, but must be within its bounding radius of " + to_text(shape_.bounding_radius()) +
                              " m");
    }
    mesh_.normals.push_back(normal);
    mesh_.points.push_back(point);
    return static_cast<Index>(mesh_.points.size() - 1);
  }

  bool is_straight(Index i, Index j) const {
    const Vector3 edge = mesh_.points[j] - mesh_.points[i];
    const Vector3 &normal1 = mesh_.normals[i], &normal2 = mesh_.normals[j];
    if ((normal1 - normal2).norm() < kClosest) return true;
    if (!(normal1.dot(normal2) > 0)) return false;
    const double length = edge.norm();
    if (length <= chord_error_) return true;
    // How far each end is below the other's tangent plane, and how far apart the ends are along it.
    const double below1 = std::max(-normal1.dot(edge), 0.0), below2 = std::max(normal2.dot(edge), 0.0);
    const auto along = [length](double below) { return std::sqrt(std::max(length * length - below * below, 0.0)); };
    return length * below1 * below2 <= chord_error_ * (below1 * along(below2) + below2 * along(below1));
  }

  /// The vertex at the middle of an edge, or kWhole if the edge is not halved.
  Index middle_of(Index i, Index j) {
    const auto [place, is_new] = middles_.try_emplace(std::minmax(i, j), kWhole);
    if (is_new && !is_straight(i, j)) {
      const Vector3 between = (mesh_.normals[i] + mesh_.normals[j]).normalized();
      place->second = add(between);
    }
    return place->second;
  }

  /// Splits every triangle along its edges that are not straight. Returns whether there was such an edge.
  bool halve_edges() {
    bool is_changed = false;
    std::vector<Triangle> old;
    old.swap(mesh_.triangles);
    for (const auto& [a, b, c] : old) {
      const Triangle middle = {middle_of(a, b), middle_of(b, c), middle_of(c, a)};
      const auto halved = std::ranges::count_if(middle, [](Index m) { return m != kWhole; });
      is_changed = is_changed || halved > 0;
      split({a, b, c}, middle, static_cast<int>(halved));
    }
    return is_changed;
  }

  void split(const Triangle& vertex, const Triangle& middle, int halved) {
    if (halved == 3) {
      const auto& [a, b, c] = vertex;
      const auto& [ab, bc, ca] = middle;
      for (const Triangle& part : {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
        mesh_.triangles.push_back(part);
      return;
    }
    if (halved == 0) {
      mesh_.triangles.push_back(vertex);
      return;
    }
    // Rotate the vertices so that the first edge is halved and, if two are, the second too.
    std::size_t first = 0;
    while (middle[first] == kWhole || (halved == 2 && middle[(first + 1) % 3] == kWhole)) ++first;
    const Index a = vertex[first], b = vertex[(first + 1) % 3], c = vertex[(first + 2) % 3], ab = middle[first];
    if (halved == 1) {
      mesh_.triangles.push_back({a, ab, c});
      mesh_.triangles.push_back({ab, b, c});
      return;
    }
    const Index bc = middle[(first + 1) % 3];
    mesh_.triangles.push_back({ab, b, bc});
    // Split the remaining quadrilateral along its shorter diagonal.
    const bool is_from_a = (mesh_.points[a] - mesh_.points[bc]).norm() < (mesh_.points[ab] - mesh_.points[c]).norm();
    mesh_.triangles.push_back(is_from_a ? Triangle{a, ab, bc} : Triangle{a, ab, c});
    mesh_.triangles.push_back(is_from_a ? Triangle{a, bc, c} : Triangle{ab, bc, c});
  }

  const Shape& shape_;
  double chord_error_;
  double farthest_;  // m
  Tessellation mesh_;
  std::map<std::pair<Index, Index>, Index> middles_;
};

}  // namespace

Tessellation tessellate(const Shape& shape, double chord_error) {
  const double least = kLeastChordError * shape.half_extents().maxCoeff();
  if (!(chord_error >= least && chord_error < INFINITY)) {
    throw std::invalid_argument("chord_error = " + to_text(chord_error) + " m, but must be in [" + to_text(least) +
                                ", inf): a millionth of the body's largest half-extent, or more");
  }
  return Tessellator(shape, chord_error).run();
}

}  // namespace supernormal
