// The search for the contacts of a body with a triangle surface, the implementation of MeshContacts.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contact/mesh/arc.hpp"
#include "contact/mesh/surface.hpp"
#include "supernormal/contact/body_box.hpp"
#include "supernormal/contact/mesh_contacts.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A contact as found. All vectors are in the frame of the surface (surface.hpp).
struct SurfaceContact {
  Vector3 normal;         ///< unit, out of the surface
  double gap = 0;         ///< m; <= 0
  double separation = 0;  ///< m; gap of the minimum translation, which differs from `gap` at an open border
  double error = 0;       ///< m
  Vector3 body_point;     ///< m
  Vector3 place;          ///< m; where a force acts. It is body_point, or on a flat side the point over the feature
  Vector3 surface_point;  ///< m; body_point - gap * normal, on the plane or line of the feature
  Vector3 feature_point;  ///< m; nearest point of the feature, not surface_point if the feature ends at a wall
  int face = 0;           ///< face with the feature
  int part = 0;           ///< part of the surface, see CoplanarPatch
  int crease = -1;        ///< index of the vertex or edge if the feature is one, else -1
  int evaluations = 0;
  Status status = Status::Converged;
};

/// Collects contacts. Keep an instance to reuse its memory.
class DistinctContacts {
 public:
  /// `length_unit`: the size of the body, m. `middle`: the middle of the body, in the frame of the surface, m.
  void clear(double length_unit, const Vector3& middle);

  /// Adds the contact. Of two contacts with the same normal and place, the deeper one is kept. Of contacts at one vertex or edge,
  /// the contact with the minimum translation distance (MTD) is kept.
  void add(const SurfaceContact& contact);

  /// Whether there is a contact with a similar normal that is at least as deep at the point.
  bool has_similar(const Vector3& normal, const Vector3& point) const;

  /// The largest separation of the contacts with this part of the surface, m. Empty if there are none.
  std::optional<double> shortest_separation(int part) const;

  /// Keeps only the shortest translation that separates the body from each convex part of the solid. Two contacts belong to one
  /// convex part if neither feature is in front of the other's tangent plane. By convexity they then overlap by more than the
  /// body's radius of curvature. So contacts of a body that rests on or against several parts are never merged. A body whose middle
  /// is behind the deeper plane does not rest there: it has come through a plate or a ridge from the other side.
  void keep_shortest_separations();

  /// Sorts by depth, deepest first.
  void sort();

  const std::vector<SurfaceContact>& contacts() const { return contacts_; }

 private:
  bool are_of_one_part(const SurfaceContact& deeper, const SurfaceContact& other) const;

  std::vector<SurfaceContact> contacts_;
  double length_unit_ = 1;
  Vector3 middle_ = Vector3::Zero();
};

/// Implements MeshContacts; see there for the contract (supernormal/contact/mesh_contacts.hpp).
class MeshContactSearch {
 public:
  /// The contacts with gaps up to `near` (m). The search is one of overlaps, for the body swept by a ball of this radius: its
  /// normals are the same, and its gaps are less by the radius. At a border the rule for tiles asks the body itself.
  std::span<const MeshContact> find(const Shape& body, const Pose& pose, std::span<const MeshTriangle> triangles,
                                    const Settings& settings, double near);

  std::span<const MeshContact> continued() const { return continued_; }
  bool has_normal(const Vector3& normal, const Vector3& point) const;
  int evaluations() const { return evaluations_; }

 private:
  /// The support point of the body against one patch.
  struct PatchSupport {
    Vector3 deepest;       // the body's point, m
    double gap;            // distance from the patch's plane, m
    bool is_over = false;  // whether the point is over the patch itself
  };

  /// The solution at vertex k of a face. Its normal may belong to an edge there.
  struct VertexContact {
    int face;
    int k;
    Proximity found;
  };

  void find_for(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles);
  void prepare(const Shape& shape, const Pose& pose, std::span<const MeshTriangle> triangles);
  void look_at_patches(SupportProbe& probe);
  SurfaceContact contact_at(int face, const Vector3& normal, double gap, const Vector3& body_point) const;
  void find_on_patch(SupportProbe& probe, std::size_t patch);
  bool open_arc(SupportProbe& probe, int face, int side, Arc& arc, ArcSample& low, ArcSample& high) const;
  void find_on_edge(SupportProbe& probe, int face, int side);
  void find_on_arc(SupportProbe& probe, int face, int side, const Arc& arc, const ArcSample& low, const ArcSample& high);
  void find_on_vertex(SupportProbe& probe, int face, int k, const Vector3& start);
  void add_near_edges(SupportProbe& probe);
  bool is_found_beside(int corner, const Vector3& normal, double gap) const;
  bool is_corner_of_patch(int corner, int patch) const;
  Proximity solve_for_hull(SupportProbe& probe, const Vector3& origin, const Vector3* start);
  Vector3 place_at_vertex(SupportProbe& probe, const Proximity& found) const;
  bool add_at_vertex(SupportProbe& probe, int face, int k, const Proximity& found);
  double stands_on(SupportProbe& probe, const Vector3& face_normal, const Vector3& place) const;
  void find_on_border(SupportProbe& probe, int face, int side, const Arc& arc, const ArcMaximum& top, double weight);
  bool drop_below(SupportProbe& probe, SurfaceContact& contact) const;
  void level_at_vertex(SupportProbe& probe, SurfaceContact& contact) const;
  Vector3 face_normal_at(int corner, const Vector3& normal) const;
  void find_beyond_rim(SupportProbe& probe, std::size_t patch);
  void add_beyond_rim();
  void find_other_separations(SupportProbe& probe);
  std::optional<double> depth_cutoff(int part) const;
  void find_shorter_over_edges(SupportProbe& probe, int face, double known);
  void find_shorter_over_vertices(SupportProbe& probe, int part, double known);
  double arc_tolerance() const;
  double touch() const;
  bool is_edge_owned_by_neighbour(int face, int side) const;
  bool is_normal_of_edge_at(int corner, const Vector3& normal) const;
  bool is_outside_at(int corner, const Vector3& normal) const;
  bool has_complete_neighbourhood(const SupportProbe& probe, const Vector3& point) const;
  bool touches_surface(SupportProbe& probe, const SurfaceContact& contact) const;
  bool overlaps(const Proximity& found, double gap) const;
  Proximity meet_face(SupportProbe& probe, const Face& face) const;
  void find_shortest_exit(SupportProbe& probe);
  MeshContact to_world(const SurfaceContact& found) const;

  const Shape* body_ = nullptr;
  double swept_ = 0;                  // m; the radius of the ball
  Vector3 origin_ = Vector3::Zero();  // of the frame of the surface, m
  BodyBox box_;
  std::vector<MeshTriangle> near_;
  double length_unit_ = 1;
  Settings settings_;
  Surface surface_;
  std::vector<PatchSupport> supports_;     // one for each patch
  std::vector<char> settled_;              // per vertex: whether its contact is found or ruled out
  std::vector<VertexContact> near_edges_;  // pending until the contacts of the edges are known
  std::vector<Vector3> hull_;              // the points of the current hull
  DistinctContacts found_;
  DistinctContacts beyond_rim_;  // candidates for contacts beyond the rim of a patch
  std::vector<MeshContact> contacts_;
  std::vector<MeshContact> continued_;  // contacts beyond a rim that a similar one makes redundant
  int evaluations_ = 0;
};

}  // namespace supernormal
