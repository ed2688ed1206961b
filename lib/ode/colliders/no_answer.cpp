#include "ode/colliders/no_answer.hpp"

#include <stdexcept>
#include <string>

#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/support/require.hpp"

namespace supernormal::ode {
namespace {

std::string text_of(const Vector3& v) { return "(" + to_text(v.x()) + ", " + to_text(v.y()) + ", " + to_text(v.z()) + ")"; }

std::string named(dGeomID geom, const char* name) {
  return name == nullptr ? geom_class_name(geom) : std::string(name) + " (" + geom_class_name(geom) + ")";
}

void require_usable_pose(dGeomID geom, const char* name) {
  // These have no pose, or may have none. ODE aborts when asked for it.
  if (dGeomGetClass(geom) == dPlaneClass || dGeomGetClass(geom) == dHeightfieldClass) return;
  const Pose pose{to_vector(dGeomGetPosition(geom)), to_rotation(dGeomGetRotation(geom))};
  if (is_usable(pose)) return;
  if (is_usable(Pose{pose.position, Matrix3::Identity()})) {
    const Matrix3& R = pose.rotation;
    throw std::invalid_argument("the pose of " + named(geom, name) + " is not finite: rotation = (" + text_of(R.row(0)) + ", " +
                                text_of(R.row(1)) + ", " + text_of(R.row(2)) + ")");
  }
  throw std::invalid_argument("the pose of " + named(geom, name) + " is not finite, or its position is not within " +
                              to_text(kFarthest) + " m: position = " + text_of(pose.position) + " m");
}

}  // namespace

void refuse_pair(dGeomID ours, dGeomID collider, const char* our_name, const char* collider_name) {
  require_usable_pose(ours, our_name);
  require_usable_pose(collider, collider_name);
  throw std::invalid_argument("the numbers that describe " + named(collider, collider_name) +
                              " and its pose, or what a user-defined body returned, are not finite, or a width is not positive");
}

void refuse_class(dGeomID collider, const char* name) {
  throw std::invalid_argument(
      std::string(name) + " is " + geom_class_name(collider) +
      ", but must be a body made by snCreate… or one of ODE's own geoms (not a space, not a dGeomTransform)");
}

}  // namespace supernormal::ode
