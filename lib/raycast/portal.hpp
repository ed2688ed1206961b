// A triangle of boundary points around a line: a portal.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "base/tangent_plane.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Up to three boundary points of a body, projected along a line with direction v. There are two states. If the points surround the
/// line, it passes through the body for certain. Otherwise they leave a sector of directions free, in which the line may pass
/// beside the body.
///
/// If they surround the line, their triangle lies in the body. So its intersection with the line is an upper bound on the entry.
/// The portal is from Snethen, "Xenocollide", Game Programming Gems 7, 2008; the bounds are from cutting-plane methods.
class Portal {
 public:
  /// `direction` v has unit length; `rounding` (m) is the rounding error of the points.
  Portal(const Vector3& direction, double rounding);

  /// Adds a boundary point r as `d` = c - r. Here c is the point of the line nearest to the body's origin. Keeps the points that
  /// give the best bounds. Returns whether r is one of them.
  bool add(const Vector3& d);

  /// Whether the points surround the line.
  bool is_pierced() const { return simplex_.count > 0; }

  /// m; the line enters the body no later than at c + upper_bound() v. Infinite while no bound is known.
  double upper_bound() const { return bound_; }

  /// m; the supporting plane with normal m meets the line at c + t v with t m.v >= -support_bound(m).
  double support_bound(const Vector3& m) const;

  /// The normal of the triangle, with normal.v <= 0; not of unit length. Zero if the points and the line lie in one plane.
  Vector3 normal() const;

  // The following functions need at least one point. They are valid until the points surround the line.

  /// Whether the plane with the normal w may separate the body from the line. w is perpendicular to v.
  bool may_separate(const Vector3& w) const;

  /// The middle of the sector of separating directions, and the normal of the projected edge that faces the line. Not of unit
  /// length.
  Vector3 bisector() const;
  Vector3 edge_normal() const;

  /// rad; the angle of the sector; 2 pi before the first point.
  double sector() const;

 private:
  struct Vertex {
    Vector2 p = Vector2::Zero();  // m; projection of d along the line
    double z = 0;                 // m; height of the point along v
    Vector3 d = Vector3::Zero();
  };
  struct Simplex {
    std::array<Vertex, 3> vertices{};
    int count = 0;
    double height = std::numeric_limits<double>::infinity();  // m; height at which the line meets the simplex
    double error = 0;  // m; bound on the rounding error of `height`, with the points' own errors
    double area = 0;   // m^2; projected along the line

    bool is_as_high(const Simplex& other) const { return std::abs(height - other.height) <= error + other.error; }
    // Two simplices are equally high if the line passes through a common edge. The larger one then has the more exact normal.
    bool is_better(const Simplex& other) const { return is_as_high(other) ? area > other.area : height < other.height; }
  };

  bool narrow(const Vertex& vertex);
  bool refine(const Vertex& vertex);
  bool is_in_front(const Vertex& vertex) const;
  // Replaces `best` by these points if they are better and the line passes between them, to rounding.
  void consider(const Vertex& a, const Vertex& b, Simplex& best) const;
  void consider(const Vertex& a, const Vertex& b, const Vertex& c, Simplex& best) const;
  Vector3 lift(const Vector2& w) const { return w.x() * e1_ + w.y() * e2_; }

  Vector3 v_, e1_, e2_;
  double rounding_;
  std::array<Vertex, 2> sector_;  // the ends of the sector, counter-clockwise; equal if there is only one point
  bool is_empty_ = true;
  Simplex simplex_;  // empty until the points surround the line
  // m; the least height so far. The simplex may be a higher triangle that is less thin.
  double bound_ = std::numeric_limits<double>::infinity();
};

}  // namespace supernormal
