// Selection of those contacts of a body with a surface that are distinct.
#pragma once

#include <optional>
#include <vector>

#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A contact as it is found: all vectors are in the frame of the surface (surface.hpp).
struct SurfaceContact {
  Vector3 normal;         ///< unit, out of the surface
  double gap = 0;         ///< m, not positive
  double separation = 0;  ///< m; the gap of the minimum translation, which differs from `gap` at an open border
  double error = 0;       ///< m
  Vector3 body_point;     ///< m
  Vector3 place;          ///< m; where a force acts: body_point, or where that may be any point of a flat side, the one of the
                          ///< body's tangent plane that is over the feature
  Vector3 surface_point;  ///< m; body_point - gap * normal, on the plane or line of the feature
  Vector3 feature_point;  ///< m; the nearest point of the feature itself, which differs from surface_point where the feature ends
                          ///< at a wall
  int face = 0;           ///< face that the feature belongs to
  int part = 0;           ///< part of the surface, see CoplanarPatch
  int crease = -1;        ///< number of the vertex or edge if the feature is one, otherwise -1
  int evaluations = 0;
  Status status = Status::Converged;
};

/// Collects contacts. Keeps its memory from one query to the next.
class DistinctContacts {
 public:
  /// `length_unit`: the body's size, m.
  void clear(double length_unit);

  /// Adds the contact, unless one with the same normal at the same place is there; of the two the deeper remains. Of contacts at
  /// one vertex or edge, the one with the minimum translation distance (MTD) remains.
  void add(const SurfaceContact& contact);

  /// Whether a contact with a similar normal is there that is at least as deep at the point.
  bool has_similar(const Vector3& normal, const Vector3& point) const;

  /// The largest separation of the contacts with this part of the surface, m; empty if there are none.
  std::optional<double> shortest_separation(int part) const;

  /// Keeps, among several translations that separate the body from one convex part of the solid, the shortest. Two contacts are
  /// of one such part when neither's feature is in front of the other's tangent plane. The bodies' convexity then implies that
  /// they overlap by more than the body's radius of curvature; contacts of a body that rests on or against several parts are
  /// never of this kind.
  void keep_shortest_separations();

  /// Sorts the contacts, deepest first.
  void sort();

  const std::vector<SurfaceContact>& contacts() const { return contacts_; }

 private:
  bool are_of_one_part(const SurfaceContact& a, const SurfaceContact& b) const;

  std::vector<SurfaceContact> contacts_;
  double length_unit_ = 1;
};

}  // namespace supernormal
