// The faces of the convex hull of points.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A point on a lattice. There it is decided exactly on which side of a plane a point lies. So coplanar, collinear and repeated
/// points are no special cases for the hull.
using LatticePoint = std::array<std::int64_t, 3>;

/// Coordinates are in [-kLatticeHalfWidth, kLatticeHalfWidth]. This is the largest range in which a sum of three products of three
/// differences stays within 64 bits.
inline constexpr std::int64_t kLatticeHalfWidth = std::int64_t{1} << 19;

/// Quickhull (Barber, Dobkin and Huhdanpaa, "The quickhull algorithm for convex hulls", ACM Trans. Math. Softw. 22, 1996) with
/// exact arithmetic. Reuses its memory from one hull to the next.
class ConvexHull {
 public:
  struct Face {
    std::array<std::size_t, 3> vertices;    ///< indices into points(), counter-clockwise seen from outside
    std::array<std::size_t, 3> neighbours;  ///< neighbours[k] lies across the edge from vertices[k] to vertices[k + 1]
    LatticePoint normal;                    ///< outward; its length is twice the area
    std::size_t first_outside;              ///< head of the list of points in front of the face, while the hull grows
    bool is_removed;
  };

  /// Builds the hull of `points`. Their order does not matter.
  void build(std::span<const LatticePoint> points);

  /// The points, sorted, without repetitions, with the points inside the hull.
  std::span<const LatticePoint> points() const { return points_; }

  /// A neighbour of a face.
  const Face& face(std::size_t index) const { return faces_[index]; }

  /// Calls `visit(face)` for every triangle of the surface. For coplanar points these are both sides of each triangle; for
  /// collinear points there are none.
  template <typename Visit>
  void for_each_face(Visit&& visit) const {
    for (const Face& face : faces_) {
      if (!face.is_removed) visit(face);
    }
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  bool start();
  std::size_t add_face(std::size_t a, std::size_t b, std::size_t c);
  std::int64_t height(const Face& face, std::size_t point) const;
  std::size_t farthest_outside(const Face& face) const;
  void collect_visible(std::size_t face, std::size_t point);
  void grow(std::size_t face);
  void hand_over(std::size_t point, std::size_t first_face);

  struct Edge {
    std::size_t from, to;      // the edge, in the direction of the visible face
    std::size_t beyond, side;  // the face that stays, and the index of the edge in it
  };

  std::vector<LatticePoint> points_;
  std::vector<Face> faces_;
  std::vector<std::size_t> next_outside_;  // the lists of first_outside: the next point, for each point
  std::vector<std::size_t> face_from_;     // for each point: the new face whose horizon edge starts there
  std::vector<std::size_t> visible_;
  std::vector<Edge> horizon_;
};

}  // namespace supernormal
