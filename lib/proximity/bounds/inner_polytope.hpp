// The hull of boundary points around the origin, whose facets bound the gap function.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A closed surface of triangles around the origin, all of whose vertices are points of one convex body.
///
/// Lemma. Let every ray from the origin meet the surface, and let r be the least distance of its triangles from the origin. Then
/// the body contains the ball of radius r about the origin, and its gap function is nowhere above -r.
/// Proof. A triangle lies in the body, and so does the segment from the origin, which the body contains, to any of its points. On
/// every ray one of these is as long as r. A body that contains the ball has the support plane of every normal beyond it.
///
/// The surface need not be convex for that. Where rounding leaves it so the bound is the same, and where a vertex would turn a
/// triangle away from the origin it is not added. In exact arithmetic the surface is the convex hull of its vertices: it grows as
/// in the expanding polytope algorithm (van den Bergen, Proximity queries and penetration depth computation on 3D game objects,
/// GDC 2001).
class InnerPolytope {
 public:
  using Index = std::uint32_t;

  /// A triangle and the distance of its nearest point.
  struct Nearest {
    Index facet;
    double distance;  ///< m; no triangle is nearer
    Vector3 normal;   ///< unit, outward
  };

  /// Starts from a tetrahedron that has the origin inside; false where it has not, or is flat. Its vertices are points of the body
  /// less `centre`, a point so near to the origin that its distance counts as an error: the surface is one around the centre.
  bool start(const std::array<Vector3, 4>& tetrahedron, const Vector3& centre = Vector3::Zero());

  /// Adds a point that lies beyond a facet that is the nearest, or beyond any. Returns whether the surface has changed.
  bool add(const Vector3& point, const Nearest& facet);
  bool add(const Vector3& point);

  /// The facet nearest to the origin, of those that were not given up.
  Nearest nearest();

  /// Leaves a facet as it is: it still bounds distance(), but will not be the nearest any more.
  void give_up(const Nearest& facet);

  /// m; the ball about the origin with this radius is in the body.
  double inner_radius();

 private:
  struct Facet {
    std::array<Index, 3> vertex;     // counter-clockwise as seen from outside
    std::array<Index, 3> neighbour;  // across the edge from the vertex of this place to the next
    Vector3 normal;                  // unit, outward; zero where the triangle has no area
    double height;                   // m; of the plane
    bool is_removed;
    std::uint32_t visit;  // the last search that saw it
  };
  struct Entry {
    double distance;  // m; a lower bound, or exact
    Index facet;
    bool is_exact;  // the distance of the triangle and not of its plane
  };
  struct Edge {
    Index from, to, outer;  // two vertices, and the facet that stays
    Vector3 normal;         // of the facet that takes the edge
  };

  static bool is_farther(const Entry& a, const Entry& b) { return a.distance > b.distance; }
  double height_above(Index facet, const Vector3& point) const;
  bool replace_visible(const Vector3& vertex, Index seen);
  bool find_horizon(const Vector3& point, Index seen, double level);
  void walk(const Vector3& point, double level, Index facet, Index across);
  bool is_closed_cone(const Vector3& apex);
  Index add_facet(const std::array<Index, 3>& vertex, const Vector3& normal);
  bool is_foot_inside(const Facet& facet) const;
  void drop_removed();

  std::vector<Vector3> vertices_;
  std::vector<Facet> facets_;
  std::vector<Entry> heap_;     // the nearest first, with entries of removed facets
  std::vector<Edge> horizon_;   // in order around the point that is being added
  std::vector<Index> visible_;  // facets that it sees
  std::uint32_t visit_ = 0;
  Vector3 centre_ = Vector3::Zero();
  double given_up_ = 0;  // m
  double length_ = 0;    // m; of the longest vertex: rounding is that of its components
};

}  // namespace supernormal
