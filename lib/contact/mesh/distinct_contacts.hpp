// Selection of the distinct contacts of a body and a surface.
#pragma once

#include <optional>
#include <vector>

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
  /// `length_unit`: the size of the body, m.
  void clear(double length_unit);

  /// Adds the contact. Of two contacts with the same normal and place, the deeper one is kept. Of contacts at one vertex or edge,
  /// the contact with the minimum translation distance (MTD) is kept.
  void add(const SurfaceContact& contact);

  /// Whether there is a contact with a similar normal that is at least as deep at the point.
  bool has_similar(const Vector3& normal, const Vector3& point) const;

  /// The largest separation of the contacts with this part of the surface, m. Empty if there are none.
  std::optional<double> shortest_separation(int part) const;

  /// Keeps only the shortest translation that separates the body from each convex part of the solid. Two contacts belong to one
  /// convex part if neither feature is in front of the other's tangent plane. By convexity they then overlap by more than the
  /// body's radius of curvature. So contacts of a body that rests on or against several parts are never merged.
  void keep_shortest_separations();

  /// Sorts by depth, deepest first.
  void sort();

  const std::vector<SurfaceContact>& contacts() const { return contacts_; }

 private:
  bool are_of_one_part(const SurfaceContact& a, const SurfaceContact& b) const;

  std::vector<SurfaceContact> contacts_;
  double length_unit_ = 1;
};

}  // namespace supernormal
