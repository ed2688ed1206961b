// The flat faces of a superellipsoid.
#pragma once

#include <array>
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
};

/// The faces of a body, at most three. A round body has none. A face that is flat along one axis only, as the side of a can, is no
/// polygon and is left out. The polygons come from find_plane_contact_manifold(), for a body that only just touches a plane.
std::vector<Face> find_faces(const supernormal::Superellipsoid& body);

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
