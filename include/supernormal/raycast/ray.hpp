// A body and a ray.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The point where a ray meets the boundary of a body. Point and normal are in the frame of the query.
struct RayHit {
  bool hit = false;                      ///< whether the ray meets the boundary within its length
  bool from_inside = false;              ///< the origin is inside the body, and the ray leaves it at the hit
  double distance = 0;                   ///< m; from the origin to the hit, along the ray
  double distance_error = 0;             ///< m; estimate of the error of `distance`
  double boundary_error = 0;             ///< m; bound on the distance of `point` from the boundary, to rounding
  Vector3 point = Vector3::Zero();       ///< m
  Vector3 normal = Vector3::UnitX();     ///< unit; the outward normal at the hit, also from inside
  int evaluations = 0;                   ///< evaluations of the support function
  Status status = Status::InvalidInput;  ///< how the query ended
};

/// Finds the first point of the boundary on the ray from `origin` along `direction`: where the ray enters the body or, if the
/// origin is inside, where it leaves. A ray that begins or ends on the boundary meets it. A ray that is wholly inside does not. The
/// body may be any shape, with or without a Hessian, faces and edges.
///
/// `origin` is in m. `direction` has unit length, to 1e-6, and is normalised. `length` is in m, in [0, inf]. Of the settings,
/// `tolerance` (of boundary_error, relative to the body's smallest half-extent) and `max_evaluations` are used. Throws
/// std::invalid_argument if one of these is out of range. Returns Status::InvalidInput if the pose, the ray or a value from the
/// shape is not finite, or if the body is more than 1e150 m away. With any status other than Converged, `hit` is what is known so
/// far.
///
/// As a point of the boundary the hit is well conditioned at any angle. As a distance along the ray it is not where the ray grazes
/// the body. Moving the ray sideways by x changes the distance by x / |normal.direction|, and by about sqrt(2 R x) where the ray is
/// tangent, with R the radius of curvature. distance_error allows for this. Hit or miss is decided to rounding, whatever the
/// tolerance: to about 1e-14 of the body's size and of its distance from the line. On a flat face of a body without a Hessian the
/// normal is accurate to about the square root of the tolerance.
SUPERNORMAL_API RayHit find_ray_hit(const Shape& shape, const Pose& pose, const Vector3& origin, const Vector3& direction,
                                    double length, const Settings& settings = {});

/// The proximity of a body (body 1) and the segment that the ray covers (body 2). If they are apart, it is their distance. If the
/// ray passes through the body, it is the depth by which one must be moved to clear the other. The arguments are the arguments of
/// find_ray_hit().
SUPERNORMAL_API Proximity find_ray_proximity(const Shape& shape, const Pose& pose, const Vector3& origin, const Vector3& direction,
                                             double length, const Settings& settings = {});

}  // namespace supernormal
