#include "ode/colliders/impact.hpp"

#include <algorithm>
#include <cmath>

#include "ode/colliders/convex/posed_shape.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"

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
};

Impact meet_body(const Mover& mover, dGeomID collider, double horizon) {
  const Mover other(collider);
  return find_time_of_impact(mover.body.shape(), mover.motion, other.body.shape(), other.motion, horizon,
                             combined(mover.body.settings(), other.body.settings()));
}

Impact meet_shape(const Mover& mover, dGeomID collider, double horizon) {
  const PosedShape other(collider);
  const Motion motion = motion_of(collider, other.pose());
  return find_time_of_impact(mover.body.shape(), mover.motion, other.shape(), motion, horizon, mover.body.settings());
}

Impact meet_plane(const Mover& mover, dGeomID collider, double horizon) {
  dVector4 plane;
  dGeomPlaneGetParams(collider, plane);
  return find_plane_time_of_impact(mover.body.shape(), mover.motion, to_vector(plane), plane[3], horizon, mover.body.settings());
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
    case dPlaneClass:
      return meet_plane(mover, collider, horizon);
    case dTriMeshClass:
      return find_trimesh_impact(ours, collider, horizon);
    case dHeightfieldClass:
      return find_heightfield_impact(ours, collider, horizon);
    default:
      return meet_shape(mover, collider, horizon);
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
