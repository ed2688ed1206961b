#include "ode/colliders/no_answer.hpp"

#include <stdexcept>
#include <string>

#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/support/require.hpp"

namespace supernormal::ode {
namespace {

std::string text_of(const Vector3& v) { return "(" + to_text(v.x()) + ", " + to_text(v.y()) + ", " + to_text(v.z()) + ")"; }

void require_usable_pose(dGeomID geom) {
  // These have no pose, or may have none. ODE aborts when asked for it.
  if (dGeomGetClass(geom) == dPlaneClass || dGeomGetClass(geom) == dHeightfieldClass) return;
  const Pose pose{to_vector(dGeomGetPosition(geom)), to_rotation(dGeomGetRotation(geom))};
  if (is_usable(pose)) return;
  if (is_usable(Pose{pose.position, Matrix3::Identity()})) {
    const Matrix3& R = pose.rotation;
    throw std::invalid_argument("the pose of " + geom_class_name(geom) + " is not finite: rotation = (" + text_of(R.row(0)) + ", " +
                                text_of(R.row(1)) + ", " + text_of(R.row(2)) + ")");
  }
  throw std::invalid_argument("the pose of " + geom_class_name(geom) + " is not finite, or its position is not within " +
                              to_text(kFarthest) + " m: position = " + text_of(pose.position) + " m");
}

}  // namespace

void refuse_pair(dGeomID ours, dGeomID collider) {
  require_usable_pose(ours);
  require_usable_pose(collider);
  throw std::invalid_argument("the numbers that describe " + geom_class_name(collider) +
                              " and its pose, or what a user-defined body returned, are not finite");
}

void refuse_class(dGeomID collider) {
  throw std::invalid_argument(
      "the collider is " + geom_class_name(collider) +
      ", but must be a body made by snCreate… or one of ODE's own geoms (not a space, not a dGeomTransform)");
}

}  // namespace supernormal::ode
