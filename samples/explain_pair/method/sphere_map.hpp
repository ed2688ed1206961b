// Equal-area maps of the sphere of normals.
#pragma once

#include <Eigen/Core>
#include <numbers>
#include <supernormal/shapes/shape.hpp>

namespace explain_pair {

using supernormal::Vector3;
using Vector2 = Eigen::Vector2d;

constexpr double kDegree = std::numbers::pi / 180;  ///< rad

/// A right-handed frame of unit vectors, for the picture of the pair and for the maps. On a map, `right` is the centre, `up` is
/// north, and east is away from the viewer.
struct Frame {
  Vector3 right, up, toward;

  Vector3 from_world(const Vector3& v) const { return {right.dot(v), up.dot(v), toward.dot(v)}; }
  Vector3 to_world(const Vector3& v) const { return v.x() * right + v.y() * up + v.z() * toward; }
};

/// A point of the sphere by its angles, rad.
struct Place {
  double longitude;  ///< in [-pi, pi], east of the centre
  double latitude;   ///< in [-pi / 2, pi / 2]
};

Vector3 normal_at(const Frame& frame, const Place& place);
Place place_of(const Frame& frame, const Vector3& normal);

/// Hammer's map of the whole sphere to an ellipse with half-axes 2 sqrt(2) and sqrt(2). (Snyder, Map projections, USGS 1987, eqs.
/// 24-1 to 24-5: Lambert's map with halved longitudes, stretched.)
struct HammerMap {
  static const double kHalfWidth, kHalfHeight;
  static Vector2 to_plane(const Place& place);
  static Place to_sphere(const Vector2& point);
};

/// Lambert's azimuthal map about the centre. Distances from the centre are 2 sin(angle / 2). (Snyder, eqs. 24-2 and 20-18.)
struct LambertMap {
  static Vector2 to_plane(const Frame& frame, const Vector3& normal);
  static Vector3 to_sphere(const Frame& frame, const Vector2& point);  ///< at most 2 from the centre
};

}  // namespace explain_pair
