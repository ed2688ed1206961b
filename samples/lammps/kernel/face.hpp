// The flat faces and the straight sides of a superellipsoid.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace granular {

using supernormal::Matrix3;
using supernormal::Vector3;
using Vector2 = Eigen::Vector2d;

/// A face across an axis of the body, at both of its ends: the polygon on which the body stands, symmetric about both other axes.
struct Face {
  static constexpr int kMostVertices = 8;  ///< 4, or 8 for a round face

  int axis = 0;       ///< of the body's frame: 0, 1 or 2
  double height = 0;  ///< m; distance of the polygon from the centre
  double width = 0;   ///< m; the smaller extent of the polygon
  /// rad; tilted by at most this against a plane, the polygon reaches as far as the body. Tilted by more, the body touches beside
  /// it.
  double tilt = 0;
  double bulge = 0;  ///< m; the vertices stick out of the rounded body by at most this
  /// m; along the two following axes, counter-clockwise about the axis.
  std::array<Vector2, kMostVertices> vertices;
  int count = 0;  ///< the first `count` vertices are valid

  std::span<const Vector2> outline() const { return std::span(vertices).first(static_cast<std::size_t>(count)); }
};

/// The faces of a body, at most three. A round body has none. A face that is flat along one axis only, as the side of a can, is no
/// polygon and is left out: it is a Side. The polygons come from find_plane_contact_manifold(), for a body that only just touches a
/// plane.
std::vector<Face> find_faces(const supernormal::Superellipsoid& body);

/// A side that is flat along one axis only. The body touches a plane along a line there: the side of a can, whose sections across
/// the axis are round, or the sides of a body with a boxy outline and a round profile. The line ends on two curves of the body's
/// frame. Like a face, the curves stick out of the rounded body by at most `bulge`.
struct Side {
  int along = 2;                  ///< the axis that the lines are parallel to
  int across = 2;                 ///< the axis that the side is across; `along` if it runs all around, as on a can
  double reach = 0;               ///< m; of the ends from the middle, along the axis
  double tilt = 0;                ///< rad; as in Face
  double bulge = 0;               ///< m
  Vector3 half_axes;              ///< m; of the body
  double delta = 2, epsilon = 2;  ///< of the body

  /// Where a curve reaches farthest along a direction.
  struct End {
    double support;   ///< m; along the direction
    Vector3 point;    ///< m
    Vector3 place;    ///< m; the point, but smooth where the curve is flat: there the point almost jumps
    Vector3 roll;     ///< the place moves by roll (by_roll . d(normal))
    Vector3 by_roll;  ///< m
    double bend;      ///< 1/m; the second derivative of `support` along t is bend (by_roll . t)^2. Infinite where the curve is flat
  };
  /// The curve at one of the ends; `sign`: 1 or -1, or 0 for the middle. `normal` is unit, in the body's frame. The point is the
  /// gradient of `support`.
  End end(const Vector3& normal, int sign) const;
  /// How much of a vector is across the side.
  double part_across(const Vector3& normal) const;
};

/// The largest sqrt(x^2 + y^2) on |x/a|^e + |y/b|^e = 1.
double farthest(double a, double b, double e);

/// The sides of a body, at most two.
std::vector<Side> find_sides(const supernormal::Superellipsoid& body);

/// One end of a face, in the world.
struct FacePose {
  const Face* face = nullptr;
  Matrix3 frame;   ///< columns: two axes in the face, and its outward normal; right-handed
  Vector3 centre;  ///< m

  FacePose() = default;
  /// `sign`: 1 or -1; which end.
  FacePose(const Face& end, int sign, const supernormal::Pose& pose);
};

}  // namespace granular
