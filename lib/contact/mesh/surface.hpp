// A triangle surface whose faces know their neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/mesh/mesh_triangle.hpp"

namespace supernormal {

inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The vertex of a face that follows vertex k.
inline int next_corner(int k) { return k == 2 ? 0 : k + 1; }

/// How two faces meet at an edge, seen from outside.
enum class EdgeConvexity { Border, Flat, Convex, Concave };

struct Face {
  std::array<Vector3, 3> vertices;
  std::array<Vector3, 3> outward;  ///< unit, in the plane, across edge k, which goes from vertex k to the next one
  Vector3 normal;                  ///< unit, out of the solid
  double seam;                     ///< m; vertices of other faces nearer than this are meant to be its own
  std::array<int, 3> corner;       ///< numbers of the vertices; vertices within a seam have the same number
  std::array<int, 3> neighbour;    ///< the face across edge k, or -1
  std::array<EdgeConvexity, 3> convexity;
  std::array<double, 3> crack;  ///< m; how far the neighbour's vertices are from those of edge k; a seam at a border
  int triangle;                 ///< the caller's number for the triangle
  int patch;                    ///< number of the CoplanarPatch that it belongs to
  int next_in_patch;            ///< next face of that patch, or -1
};

/// Faces that share flat edges: a piece of a plane.
struct CoplanarPatch {
  Vector3 normal;  ///< unit
  int first_face;
  int part;  ///< patches that share convex edges are of one part, which has the number of one of them
};

/// A surface in a frame with the origin near the body: coordinates of triangles far from the world's origin lose no digits.
/// Keeps its memory from one build() to the next.
class Surface {
 public:
  /// `length_unit` (m) is the size of the body that is to touch it.
  void build(std::span<const MeshTriangle> triangles, const Vector3& origin, double length_unit);

  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<CoplanarPatch>& patches() const { return patches_; }
  int corner_count() const { return corner_count_; }
  int part_of(const Face& face) const { return patches_[static_cast<std::size_t>(face.patch)].part; }

  /// Points nearer to one another than this are one by rounding, m.
  double rounding() const { return rounding_; }

  /// Features thinner than this (m) do not separate: cracks between triangles that were meant to meet, slivers.
  double contact_tolerance() const { return contact_tolerance_; }

  /// Whether the projection of the point into the face's plane is within the face, or in a crack beside it, or within rounding.
  bool is_over(const Face& face, const Vector3& point) const;

  /// The point of the patch's rim nearest to `point`, which is over none of its faces, with the face and edge there.
  Vector3 nearest_on_rim(const CoplanarPatch& patch, const Vector3& point, int& face, int& side) const;

  /// The first face from number `first` on that is a wall there: it rises from the tangent plane with the normal at the surface's
  /// point `at`, and `beyond` is behind it, so that the feature that ends at `at` goes on inside of the wall's solid as far as
  /// `beyond`. Returns -1 if there is none.
  int find_wall(const Vector3& normal, const Vector3& at, const Vector3& beyond, int first = 0) const;

  /// Whether a face that touches `at` stands out of the tangent plane there, so that the normal is outside the normal cone of the
  /// surface at `at`. A wall with `foot` behind it does not count.
  bool violates_normal_cone(const Vector3& normal, const Vector3& at, const Vector3& foot) const;

  /// Whether the segment meets a face; the face `first` is tested first.
  bool is_crossed(const Vector3& start, const Vector3& end, int first) const;

  /// Whether the first face that the segment meets is met from inside: the segment starts in the solid, or on it, and leaves it.
  bool exits_solid(const Vector3& start, const Vector3& end) const;

 private:
  struct EdgeUse {
    std::uint64_t edge;  // its two vertices
    int face;
    int side;  // number k of the edge in the face
  };

  void append(const MeshTriangle& triangle, const Vector3& origin, double length_unit);
  void number_corners();
  int find_corner_beside(const Vector3& in_cell, const Vector3& own, double seam, std::size_t face, std::size_t k) const;
  int find_corner_in(const Vector3& cell, std::size_t face, std::size_t k) const;
  void enter_corner(const Vector3& cell, std::size_t face, std::size_t k);
  void match_edges();
  void match_uses(std::span<EdgeUse> uses);
  EdgeConvexity convexity_between(const Face& face, int side, const Face& neighbour) const;
  void collect_patches();
  void grow_patch(int seed);
  void join_parts();
  int find_part(int patch);
  bool touches(const Face& face, const Vector3& point) const;
  bool is_behind(const Face& face, const Vector3& at, const Vector3& point) const;
  double share_to(const Face& face, const Vector3& start, const Vector3& end) const;

  std::vector<Face> faces_;
  std::vector<CoplanarPatch> patches_;
  std::vector<int> corner_table_;  // a hash table of 3 * face + k, -1 where empty
  std::vector<EdgeUse> uses_;
  std::vector<int> to_visit_;
  int corner_count_ = 0;
  double largest_ = 0;
  double rounding_ = 0;
  double contact_tolerance_ = 0;
};

}  // namespace supernormal
