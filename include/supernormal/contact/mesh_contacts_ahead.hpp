// A body and the triangles of a surface that it is about to meet.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/contact/mesh_contacts.hpp"

namespace supernormal {

/// One contact of a body with a surface, with its corners.
struct MeshManifold {
  ContactManifold manifold;  ///< body 1 is the body, body 2 the surface
  int triangle = 0;          ///< MeshTriangle::index
};

/// Finds the contacts of a body with a surface that it may meet, as find_contacts_ahead() does for two bodies. It owns the scratch
/// memory: keep one per thread.
///
/// The body is moved along its velocity to where it first hits a face from outside, and from there on along what it hit, as far as
/// the time goes. At each of these places, and at the end, the contacts of MeshContacts are found for the body swept by a ball,
/// whose radius is how near is near: this sweep leaves the normals as they are and takes the radius off the gaps.
class SUPERNORMAL_API MeshContactsAhead {
 public:
  /// The middle of all the places of the body, relative to its origin, and how much farther than its box they and what is near
  /// reach.
  struct Reach {
    Vector3 middle;  ///< m
    double margin;   ///< m
  };

  /// The triangles that find() has to get are those that touch the body's box (body_box.hpp), moved by `middle` and widened by
  /// `margin`. `surface` is the motion of the surface, whose velocity is that at the body.
  static Reach reach_of(const BodyAhead& body, const MotionAhead& surface, double time);

  /// The distinct contacts, the smallest gap first. Those with a gap above ContactManifold::reach are none. Valid until the next
  /// query; empty when the pose is not finite, or its rotation none (Pose).
  std::span<const MeshManifold> find(const BodyAhead& body, const MotionAhead& surface, double time,
                                     std::span<const MeshTriangle> triangles, const Settings& settings = {});

  /// Evaluations of the support function and the gap function in the last query.
  int evaluations() const { return evaluations_; }

 private:
  struct Search;

  SUPERNORMAL_LOCAL bool holds_back(const Vector3& velocity) const;
  SUPERNORMAL_LOCAL void add_overlaps(const Search& search);
  SUPERNORMAL_LOCAL void add_contacts(const Search& search, const Vector3& way);
  SUPERNORMAL_LOCAL bool is_apart_now(const Search& search, std::span<const MeshContact> of_sweep);
  SUPERNORMAL_LOCAL void add(const Search& search, const Proximity& there, int triangle, const Vector3& way);

  MeshContacts contacts_;
  std::vector<MeshManifold> found_;
  int evaluations_ = 0;
};

}  // namespace supernormal
