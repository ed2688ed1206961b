// A triangle surface with adjacency.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/mesh/mesh_triangle.hpp"

namespace supernormal {

inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The next vertex of a face after vertex k.
inline int next_corner(int k) { return k == 2 ? 0 : k + 1; }

/// How two faces meet at an edge, seen from outside.
enum class EdgeConvexity { Border, Flat, Convex, Concave };

struct Face {
  std::array<Vector3, 3> vertices;
  std::array<Vector3, 3> outward;  ///< unit, in the plane, across edge k from vertex k to the next
  Vector3 normal;                  ///< unit, out of the solid; that of its CoplanarPatch
  double area;                     ///< m^2
  double longest;                  ///< m; longest side
  double rounding;                 ///< m; how far the vertices may be from their places
  double seam;                     ///< m; vertices of other faces within this distance are the same vertex
  std::array<int, 3> corner;       ///< indices of the vertices; vertices within a seam have the same index
  std::array<int, 3> neighbour;    ///< the face across edge k, or -1
  std::array<EdgeConvexity, 3> convexity;
  std::array<double, 3> crack;  ///< m; distance of the neighbour's vertices from edge k's; a seam at a border
  int triangle;                 ///< the caller's index of the triangle
  int patch;                    ///< index of its CoplanarPatch
  int next_in_patch;            ///< next face of that patch, or -1
};

/// Faces connected by flat edges: a piece of a plane, up to the rounding of the vertices.
struct CoplanarPatch {
  Vector3 normal;  ///< unit; mean of the faces, weighted by their areas
  double height;   ///< m; of the plane along the normal
  int first_face;
  int part;  ///< patches connected by convex edges have the same part
};

/// A surface in a frame whose origin is near the body. So triangles far from the world's origin lose no digits. Keep an instance to
/// reuse its memory.
class Surface {
 public:
  /// `length_unit` (m): the size of the touching body.
  void build(std::span<const MeshTriangle> triangles, const Vector3& origin, double length_unit);

  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<CoplanarPatch>& patches() const { return patches_; }
  int corner_count() const { return corner_count_; }
  int part_of(const Face& face) const { return patches_[static_cast<std::size_t>(face.patch)].part; }

  /// Points closer than this are equal up to rounding, m.
  double rounding() const { return rounding_; }

  /// Whether the point's projection into the face's plane is in the face or an adjacent crack, up to rounding.
  bool is_over(const Face& face, const Vector3& point) const;

  /// How far the face is above the plane of its patch, m, below a point that is over the face. Rounding moves its vertices.
  double rise_over_patch(const Face& face, const Vector3& point) const;

  /// Whether the point touches a face at the vertex `corner`.
  bool is_on_face_at(int corner, const Vector3& point) const;

  /// The point of the patch's rim nearest to `point`, with its face and edge. `point` must not be over a face of the patch.
  Vector3 nearest_on_rim(const CoplanarPatch& patch, const Vector3& point, int& face, int& side) const;

  /// Whether there is a wall at the point `at` of the surface: a face that rises from the tangent plane with this normal, with
  /// `beyond` behind it. So the feature that ends at `at` continues inside the wall's solid up to `beyond`.
  bool has_wall(const Vector3& normal, const Vector3& at, const Vector3& beyond) const;

  /// Whether the normal is outside the normal cone of the surface at `at`: a face that touches `at` rises out of the tangent plane.
  /// A wall with `foot` behind it is ignored.
  bool violates_normal_cone(const Vector3& normal, const Vector3& at, const Vector3& foot) const;

  /// Whether the segment meets a face. Tests the face `first` first.
  bool is_crossed(const Vector3& start, const Vector3& end, int first) const;

  /// Whether the segment starts in the solid, or on it, and leaves it: it meets its first face from inside.
  bool exits_solid(const Vector3& start, const Vector3& end) const;

 private:
  struct Place {
    double along;  // m; by which vertices are sorted
    int face;
    int k;  // index of the vertex in the face
  };
  struct EdgeUse {
    std::uint64_t edge;  // its two vertices
    int face;
    int side;  // index k of the edge in the face
  };

  void append(const MeshTriangle& triangle, const Vector3& origin, double length_unit);
  void number_corners();
  void match_edges();
  void match_uses(std::span<EdgeUse> uses);
  EdgeConvexity convexity_between(const Face& face, int side, const Face& neighbour) const;
  void level_faces();
  void collect_patches();
  void grow_patch(int seed);
  void join_parts();
  int find_part(int patch);
  bool touches(const Face& face, const Vector3& point) const;
  bool is_behind(const Face& face, const Vector3& at, const Vector3& point) const;
  double share_to(const Face& face, const Vector3& start, const Vector3& end) const;

  std::vector<Face> faces_;
  std::vector<CoplanarPatch> patches_;
  std::vector<Place> places_;
  std::vector<EdgeUse> uses_;
  int corner_count_ = 0;
  double largest_ = 0;
  double rounding_ = 0;
  double contact_tolerance_ = 0;  // m; thinner features do not separate: slivers, and cracks between triangles that should meet
};

}  // namespace supernormal
