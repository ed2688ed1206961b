// Contacts ahead of a body with the triangles of a surface.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace supernormal {

class FreeMotion;

/// One contact of a body with a surface, with its manifold points.
struct MeshManifold {
  ContactManifold manifold;  ///< body 1 is the body, body 2 the surface
  int triangle = 0;          ///< MeshTriangle::index
};

/// Finds the contacts of a body with a surface that it may meet, like find_contacts_ahead() for two bodies. It owns scratch memory:
/// use one object per thread.
///
/// The body is moved along its velocity to the first face that it hits from outside, and from there along the faces that it hits,
/// until `time` is over. MeshContacts finds the contacts at each of these places and at the end, for the body swept by a ball. The
/// ball's radius is the distance within which a triangle counts as near. Sweeping does not change the normals, and reduces the gaps
/// by the radius. The rule for the border of a sheet asks the body itself. A body that slides from face to face has the contacts
/// at the end of its way alone, for its orientation there.
///
/// If the surface is at rest, the contacts are points of the body's boundary, at present or with the orientation at the end of the
/// step. Only an impact with friction of a body whose middle is off its centre of mass is moved into the body.
class SUPERNORMAL_API MeshContactsAhead {
 public:
  /// The region that the body and everything near it cover on the way, relative to the body's box.
  struct Reach {
    Vector3 middle;  ///< m; the middle of all places of the body, relative to its origin
    double margin;   ///< m; how much farther than the box the region extends
  };

  /// The region of triangles that find() needs: all triangles that touch the body's box (body_box.hpp), moved by `middle` and
  /// widened by `margin`. `surface` is the motion of the surface, with the velocity at the body. `time` in s.
  static Reach reach_of(const BodyAhead& body, const MotionAhead& surface, double time);

  /// The distinct contacts, the smallest gap first. A gap above ContactManifold::reach is no contact. `time` in s. The result is
  /// valid until the next query. It is empty if the pose is not finite, or its matrix is not a rotation (Pose).
  std::span<const MeshManifold> find(const BodyAhead& body, const MotionAhead& surface, double time,
                                     std::span<const MeshTriangle> triangles, const Settings& settings = {});

  /// Number of evaluations of the support function and the gap function in the last query.
  int evaluations() const { return evaluations_; }

 private:
  struct Search;
  struct SurfaceFrame;

  SUPERNORMAL_LOCAL bool holds_back(const Vector3& velocity) const;
  SUPERNORMAL_LOCAL void leave_free_motion(const Search& search);
  SUPERNORMAL_LOCAL std::optional<MeshManifold> find_after(const Search& search, const FreeMotion& motion,
                                                           std::span<const MeshTriangle> triangles);
  SUPERNORMAL_LOCAL MeshContact find_nearest_of_surface(const Search& search, const Pose& there,
                                                        std::span<const MeshTriangle> triangles);
  SUPERNORMAL_LOCAL bool goes_through(const Search& search, const Pose& now, const Pose& end, const Vector3& downwards,
                                      const ContactManifold* floor);
  SUPERNORMAL_LOCAL std::span<const MeshTriangle> leave_in_front(const Search& search, std::span<const MeshTriangle> triangles,
                                                                 const ContactManifold& floor);
  SUPERNORMAL_LOCAL double add_overlaps(const Search& search);
  SUPERNORMAL_LOCAL void add_contacts(const Search& search, const Vector3& way);
  SUPERNORMAL_LOCAL bool slides(const Search& search) const;
  SUPERNORMAL_LOCAL void find_at_end(const Search& search, BodyAhead& there, const Vector3& way);
  SUPERNORMAL_LOCAL void add_continued(const Search& search, const Vector3& way);
  SUPERNORMAL_LOCAL bool is_apart_now(const Search& search, std::span<const MeshContact> contacts);
  SUPERNORMAL_LOCAL double approach_in_excess(const Search& search, const Proximity& there);
  SUPERNORMAL_LOCAL ContactManifold manifold_of(const Search& search, const Pose& pose, const Proximity& there, double approach);
  SUPERNORMAL_LOCAL void add(const Search& search, Proximity there, int triangle, const Vector3& way);

  MeshContacts contacts_;
  std::vector<MeshManifold> found_;
  std::vector<MeshTriangle> in_front_;
  int evaluations_ = 0;
};

}  // namespace supernormal
