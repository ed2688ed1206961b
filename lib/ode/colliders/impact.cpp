#include "ode/colliders/impact.hpp"

#include <array>
#include <cmath>

#include "ode/colliders/convex/convex_vertices.hpp"
#include "ode/colliders/convex/shape_of.hpp"
#include "ode/colliders/no_answer.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/geom/solver_settings.hpp"
#include "proximity/thread_kept.hpp"
#include "supernormal/shapes/polytope.hpp"

namespace supernormal::ode {
namespace {

// Length of a piece of a path, in sizes of the body, and the most pieces.
constexpr double kPieceSizes = 8;
constexpr double kMostPieces = 1000;

/// A moving geom of ours.
struct Mover {
  const Body& body;
  Motion motion;

  explicit Mover(dGeomID geom) : body(require_body(geom)), motion(motion_of(geom, pose_of(geom))) {}

  Impact meet(dGeomID collider, const Shape& shape, const Pose& pose, double horizon) const {
    return find_time_of_impact(body.shape(), motion, shape, motion_of(collider, pose), horizon, body.settings());
  }
};

Impact meet_body(const Mover& mover, dGeomID collider, double horizon) {
  const Mover other(collider);
  return find_time_of_impact(mover.body.shape(), mover.motion, other.body.shape(), other.motion, horizon,
                             combined(mover.body.settings(), other.body.settings()));
}

Impact meet_plane(const Mover& mover, dGeomID collider, double horizon) {
  dVector4 plane;
  dGeomPlaneGetParams(collider, plane);
  return find_plane_time_of_impact(mover.body.shape(), mover.motion, to_vector(plane), plane[3], horizon, mover.body.settings());
}

Impact meet_convex(const Mover& mover, dGeomID collider, double horizon) {
  thread_local ThreadKept<ConvexVertices> kept;
  ConvexVertices& vertices = *kept;
  if (!vertices.read(collider)) return {};
  return mover.meet(collider, Polytope(vertices.points()), vertices.pose(), horizon);
}

// The rotation of the geom is not read, because dGeomRaySet writes only one column of it.
Impact meet_ray(const Mover& mover, dGeomID collider, double horizon) {
  dVector3 start, along;
  dGeomRayGet(collider, start, along);
  const Vector3 half = 0.5 * double{dGeomRayGetLength(collider)} * to_vector(along);
  const std::array<Vector3, 2> ends = {-half, half};
  return mover.meet(collider, Polytope(ends), {to_vector(start) + half, Matrix3::Identity()}, horizon);
}

}  // namespace

Motion motion_of(dGeomID geom, const Pose& pose) {
  Motion motion;
  motion.pose = pose;
  const dBodyID body = dGeomGetBody(geom);
  if (body == nullptr) return motion;
  motion.velocity = to_vector(dBodyGetLinearVel(body));
  motion.angular_velocity = to_vector(dBodyGetAngularVel(body));
  motion.centre = pose.rotation.transpose() * (to_vector(dBodyGetPosition(body)) - pose.position);
  return motion;
}

Impact find_impact(dGeomID ours, dGeomID collider, double horizon) {
  const Mover mover(ours);
  const int collider_class = dGeomGetClass(collider);
  if (collider_class == geom_class()) return meet_body(mover, collider, horizon);
  switch (collider_class) {
    case dSphereClass:
      return mover.meet(collider, sphere_of(collider), pose_of(collider), horizon);
    case dBoxClass:
      return mover.meet(collider, box_of(collider), pose_of(collider), horizon);
    case dCapsuleClass:
      return mover.meet(collider, capsule_of(collider), pose_of(collider), horizon);
    case dCylinderClass:
      return mover.meet(collider, cylinder_of(collider), pose_of(collider), horizon);
    case dPlaneClass:
      return meet_plane(mover, collider, horizon);
    case dRayClass:
      return meet_ray(mover, collider, horizon);
    case dConvexClass:
      return meet_convex(mover, collider, horizon);
    case dTriMeshClass:
      return find_trimesh_impact(ours, collider, horizon);
    case dHeightfieldClass:
      return find_heightfield_impact(ours, collider, horizon);
    default:
      refuse_class(collider);
  }
}

// Relative to the surface, the body moves with the difference of the velocities and rotates about its own centre. The rotation of
// the surface about its own centre adds to this: the body's points stay within `far` of that centre.
Path::Path(const Motion& body, const Motion& surface, double reach, double horizon)
    : body_(body), surface_(surface), horizon_(horizon) {
  const auto centre = [](const Motion& motion) { return Vector3(motion.pose.position + motion.pose.rotation * motion.centre); };
  const double speed = (body.velocity - surface.velocity).norm();
  const double far = (centre(body) - centre(surface)).norm() + reach + speed * horizon;
  const double length = horizon * (speed + body.angular_velocity.norm() * reach + surface.angular_velocity.norm() * far);
  pieces_ = static_cast<int>(std::clamp(std::ceil(length / (kPieceSizes * reach)), 1.0, kMostPieces));
  travel_ = length / pieces_;
}

Motion Path::later(const Motion& motion, double time) {
  Motion then = motion;
  then.pose = pose_at(motion, time);
  return then;
}

}  // namespace supernormal::ode
