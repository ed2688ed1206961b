// A triangle of boundary points around a line.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "proximity/tangent_plane.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Up to three boundary points of a body, seen along a line with direction v: either they surround the line, so that it certainly
/// passes through the body, or they leave a sector of directions free in which the body may lie aside.
///
/// Once they surround it, the triangle between them is in the body, and the line enters the body no later than it meets the
/// triangle, which gives an upper bound. (The portal is that of Snethen, "Xenocollide", Game Programming Gems 7, 2008, with the
/// bounds of a cutting plane method.)
class Portal {
 public:
  /// `direction` v is of unit length; `rounding` (m) is the error of points.
  Portal(const Vector3& direction, double rounding);

  /// Adds a boundary point r; `d` = c - r, where c is the point of the line nearest to the body's origin. Keeps the points that
  /// give the best bounds, and returns whether this is one of them.
  bool add(const Vector3& d);

  /// Whether the points surround the line.
  bool is_pierced() const { return simplex_.count > 0; }

  /// m; the line enters the body no later than at c + upper_bound() v. Infinite while no bound is known.
  double upper_bound() const { return bound_; }

  /// The plane with normal m that supports the body meets the line at c + t v where t m.v >= -support_bound(m).
  double support_bound(const Vector3& m) const;

  /// The normal of the triangle, against v; not of unit length. Zero when the points are in a plane with the line.
  Vector3 normal() const;

  // The following functions are valid while the points do not surround the line, and there is at least one.

  /// Whether w, perpendicular to v, is in the sector of normals whose planes may separate body and line.
  bool may_separate(const Vector3& w) const;

  /// The middle of that sector, and the normal of the edge that the body turns to the line. Not of unit length.
  Vector3 bisector() const;
  Vector3 edge_normal() const;

  /// The angle of that sector, radians; a full turn before there is a point.
  double sector() const;

 private:
  struct Vertex {
    Vector2 p = Vector2::Zero();  // projection along the line, from the body to the line
    double z = 0;                 // height along v
    Vector3 d = Vector3::Zero();
  };
  struct Simplex {
    std::array<Vertex, 3> vertices{};
    int count = 0;
    double height = std::numeric_limits<double>::infinity();  // m; height at which the line meets it
    double error = 0;                                         // m; bound on its rounding error, that of the points included
    double area = 0;                                          // m^2

    bool is_as_high(const Simplex& other) const { return std::abs(height - other.height) <= error + other.error; }
    // If two simplices are equally high, as when the line is in an edge of both, the larger one has the better normal.
    bool is_better(const Simplex& other) const { return is_as_high(other) ? area > other.area : height < other.height; }
  };

  bool narrow(const Vertex& vertex);
  bool refine(const Vertex& vertex);
  bool is_in_front(const Vertex& vertex) const;
  // Replaces `best` by these points if they are better and the line passes between them, but for rounding.
  void consider(const Vertex& a, const Vertex& b, Simplex& best) const;
  void consider(const Vertex& a, const Vertex& b, const Vertex& c, Simplex& best) const;
  Vector3 lift(const Vector2& w) const { return w.x() * e1_ + w.y() * e2_; }

  Vector3 v_, e1_, e2_;
  double rounding_;
  std::array<Vertex, 2> sector_;  // counter-clockwise; both are the same if there is only one
  bool is_empty_ = true;
  Simplex simplex_;                                         // empty until the points surround the line
  double bound_ = std::numeric_limits<double>::infinity();  // m; the least of all: higher triangles may be thinner
};

}  // namespace supernormal
