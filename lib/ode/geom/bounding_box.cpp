#include "ode/geom/bounding_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/geom/look_ahead.hpp"
#include "ode/support/last_error.hpp"
#include "supernormal/contact/contacts_ahead.hpp"
#include "supernormal/proximity/plane.hpp"
#include "supernormal/shapes/bounding_box.hpp"

namespace supernormal::ode {
namespace {

// Rounding error of a support function, a rotated direction and a sum, in ulps of dReal.
constexpr double kRoundingUnits = 8;

double rounding_of(double magnitude) { return kRoundingUnits * double{std::numeric_limits<dReal>::epsilon()} * magnitude; }

/// Widens the box to where the body may touch within its look-ahead time.
void cover_motion(const Body& body, const MotionAhead& motion, BoundingBox& box) {
  const double near = nearness(motion, body.look_ahead(), body.size());
  const Vector3 displacement = body.look_ahead() * motion.velocity;
  box.low += displacement.cwiseMin(0) - Vector3::Constant(near);
  box.high += displacement.cwiseMax(0) + Vector3::Constant(near);
}

int write_finite_aabb(dGeomID geom, dReal* aabb) {
  const Pose pose = pose_of(geom);
  const Body& body = require_body(geom);
  BoundingBox box = find_bounding_box(body.shape(), pose);
  if (body.look_ahead() > 0) cover_motion(body, motion_ahead_of(geom, pose.position, body.shape().bounding_radius()), box);
  for (int axis = 0; axis < 3; ++axis) {
    const double position = pose.position[axis];
    const double low = box.low[axis];
    const double high = box.high[axis];
    if (!std::isfinite(low) || !std::isfinite(high) || low > high) return 0;  // a user-defined body may return anything
    const double margin = rounding_of(std::abs(position) + std::abs(high - position) + std::abs(position - low));
    aabb[2 * axis] = to_real(low - margin);
    aabb[2 * axis + 1] = to_real(high + margin);
  }
  return 1;
}

bool is_above_plane(dGeomID geom, const Body& body, const Pose& pose, dGeomID plane_geom) {
  dVector4 plane;
  dGeomPlaneGetParams(plane_geom, plane);
  const Vector3 normal = to_vector(plane);
  const double gap = find_plane_proximity(body.shape(), pose, normal, plane[3]).gap;
  double reach = 0;
  if (body.look_ahead() > 0) {
    const MotionAhead motion = motion_ahead_of(geom, pose.position, body.shape().bounding_radius());
    reach = reach_towards(motion, -normal, body.look_ahead(), body.size());
  }
  return gap - reach > rounding_of(pose.position.lpNorm<1>() + std::abs(double{plane[3]}) + std::abs(gap));
}

// Tests one separating plane. It is perpendicular to the line from the body's origin to the nearest point of the box. That point is
// the support point of the box, even if the box is infinite.
bool is_outside_box(const Body& body, const Pose& pose, const dReal* aabb) {
  Vector3 nearest;
  for (int axis = 0; axis < 3; ++axis) {
    nearest[axis] = std::fmin(std::fmax(pose.position[axis], double{aabb[2 * axis]}), double{aabb[2 * axis + 1]});
  }
  const Vector3 to_box = nearest - pose.position;
  const double distance = to_box.norm();
  if (!(distance > 0)) return false;
  const double reach = body.shape().support(pose.rotation.transpose() * (to_box / distance));
  return distance - reach > rounding_of(pose.position.lpNorm<1>() + distance + std::abs(reach));
}

}  // namespace

// The hash space of ODE aborts on NaN but accepts an infinite box. The colliders then refuse such a body.
void compute_aabb(dGeomID geom, dReal aabb[6]) {
  if (guarded("dGeomGetAABB", 0, [&] { return write_finite_aabb(geom, aabb); }) != 0) return;
  for (int axis = 0; axis < 3; ++axis) {
    aabb[2 * axis] = -dInfinity;
    aabb[2 * axis + 1] = dInfinity;
  }
}

int test_aabb(dGeomID geom, dGeomID other, dReal other_aabb[6]) {
  return guarded("dSpaceCollide", 1, [&] {
    const int other_class = dGeomGetClass(other);
    // Between two of our bodies, the first evaluation of the collider is the better test. In a pile of 500 grains this test saved a
    // tenth of the near callbacks and no time.
    if (other_class == geom_class()) return 1;
    const Body& body = require_body(geom);
    const Pose pose = pose_of(geom);
    if (other_class == dPlaneClass) return is_above_plane(geom, body, pose, other) ? 0 : 1;
    // With look-ahead the box covers the displacement of the body, but the tested plane does not.
    return body.look_ahead() == 0 && is_outside_box(body, pose, other_aabb) ? 0 : 1;
  });
}

// A geom with an offset would be placed with rounding, so the body is placed.
void set_moved(dGeomID geom) {
  const dBodyID body = dGeomGetBody(geom);
  const dReal* position = body != nullptr ? dBodyGetPosition(body) : dGeomGetPosition(geom);
  const dReal x = position[0], y = position[1], z = position[2];
  if (body != nullptr) {
    dBodySetPosition(body, x, y, z);
  } else {
    dGeomSetPosition(geom, x, y, z);
  }
}

}  // namespace supernormal::ode
