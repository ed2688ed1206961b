// The hull of boundary points around the origin. Its facets bound the gap function.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A closed surface of triangles around the origin. All its vertices are points of one convex body.
///
/// Lemma. Let every ray from the origin meet the surface, and let r be the least distance of its triangles from the origin. Then
/// the body contains the ball of radius r about the origin, and its gap function is nowhere above -r. Proof. The body contains the
/// origin and every triangle, so it contains the segments from the origin to the points of the triangles. On every ray one of these
/// segments has at least the length r. So the body contains the ball, and the supporting plane of every normal is beyond the ball.
///
/// The surface need not be convex for this lemma. So rounding errors that make it nonconvex do not affect the bound. A vertex that
/// would turn a triangle away from the origin is not added. In exact arithmetic the surface is the convex hull of its vertices. It
/// grows as in the expanding polytope algorithm (van den Bergen, Proximity queries and penetration depth computation on 3D game
/// objects, GDC 2001).
class InnerPolytope {
 public:
  using Index = std::uint32_t;

  /// A triangle and the distance of its nearest point.
  struct Nearest {
    Index facet;
    double distance;  ///< m; no triangle is nearer
    Vector3 normal;   ///< unit, outward
  };

  /// Starts with a tetrahedron around the origin. Returns false if the origin is not inside, or if the tetrahedron is flat. Its
  /// vertices are points of the body less `centre`. The surface is around `centre`, a point so near to the origin that its distance
  /// counts as an error.
  bool start(const std::array<Vector3, 4>& tetrahedron, const Vector3& centre = Vector3::Zero());

  /// Adds a point that lies beyond `facet`, a result of nearest(), or beyond any facet. Returns whether the surface has changed.
  bool add(const Vector3& point, const Nearest& facet);
  bool add(const Vector3& point);

  /// Offers a point of the body. nearest() adds it if it reaches the goal over the nearest facet. A point that does not would have
  /// to be followed by a farther one there. Points after the first kMostOffers are ignored.
  void offer(const Vector3& point) {
    if (offered_.size() < kMostOffers) offered_.push_back({point, false, false});
  }

  /// The body is point-symmetric about `centre` (m): the mirror images of the offered points are offered, too.
  void set_symmetry(const Vector3& centre) { symmetry_ = centre; }

  /// From now on new facets beyond this distance (m) are only known by the least of their distances. It may only fall. The surface
  /// has no goal at its start.
  void set_goal(double distance) { goal_ = distance + centre_.norm(); }

  /// The facet nearest to the origin, without the facets that were given up and those beyond the goal. Infinitely far if there is
  /// none.
  Nearest nearest();

  /// Gives up on a facet. It still bounds inner_radius(), but nearest() does not return it any more.
  void give_up(const Nearest& facet);

  /// m; the body contains the ball about the origin with this radius.
  double inner_radius();

 private:
  struct Facet {
    std::array<Index, 3> vertex;     // counter-clockwise as seen from outside
    std::array<Index, 3> neighbour;  // neighbour[k] lies across the edge from vertex[k] to vertex[k + 1]
    Vector3 normal;                  // unit, outward; zero if the triangle has no area
    double height;                   // m; distance of the plane
    bool is_removed;
    std::uint32_t visit;  // the last search that visited it
  };
  struct Entry {
    double distance;  // m; a lower bound, or exact
    Index facet;
    bool is_exact;  // whether it is the distance of the triangle and not of its plane
  };
  struct Vertex {
    Vector3 point;   // m
    double squared;  // m^2; of its norm
  };
  // The cuts of a query, and the ends of some climbs.
  static constexpr std::size_t kMostOffers = 64;
  struct Offer {
    Vector3 point;  // m
    bool is_taken, is_mirror_taken;
  };
  struct Edge {
    Index from, to, outer;  // two vertices, and the facet that stays
    Index outer_side;       // of this facet, across which the edge is
    Vector3 normal;         // of the new facet on the edge
  };

  /// No two entries are equal, because which of these comes first depends on the standard library.
  static bool is_farther(const Entry& a, const Entry& b) {
    if (a.distance != b.distance) return a.distance > b.distance;
    return a.is_exact != b.is_exact ? b.is_exact : a.facet > b.facet;
  }
  void reserve();
  double height_above(Index facet, const Vector3& point) const;
  Nearest nearest_of_heap();
  bool take_offer(const Nearest& facet, Vector3& vertex);
  bool is_beyond(const Vector3& vertex, const Nearest& facet) const;
  bool replace_visible(const Vector3& vertex, Index seen);
  bool find_horizon(const Vector3& point, Index seen, double level);
  void walk(const Vector3& point, double level, Index facet, Index across);
  bool is_closed_cone(const Vector3& apex);
  void add_vertex(const Vector3& point);
  Index add_facet(const std::array<Index, 3>& vertex, const Vector3& normal);
  bool is_foot_inside(const Facet& facet) const;
  void drop_removed();

  std::vector<Vertex> vertices_;
  std::vector<Offer> offered_;
  std::optional<Vector3> symmetry_;  // m; the centre of the body
  std::vector<Facet> facets_;
  std::vector<Entry> heap_;     // the nearest first; may contain removed facets
  std::vector<Edge> horizon_;   // in order around the added point
  std::vector<Index> visible_;  // the facets that the added point is beyond
  std::uint32_t visit_ = 0;
  Vector3 centre_ = Vector3::Zero();
  double goal_ = 0;         // m; from the centre of the surface
  double beyond_goal_ = 0;  // m; the least height of the facets that were beyond the goal
  double given_up_ = 0;     // m
  double length_ = 0;       // m; of the longest vertex, which sets the rounding error
};

}  // namespace supernormal
