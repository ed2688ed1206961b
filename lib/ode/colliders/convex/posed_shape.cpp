#include "ode/colliders/convex/posed_shape.hpp"

#include <limits>
#include <vector>

#include "base/thread_kept.hpp"
#include "ode/colliders/convex/convex_vertices.hpp"
#include "ode/colliders/no_answer.hpp"
#include "ode/geom/body.hpp"

namespace supernormal::ode {

bool has_shape(dGeomID geom) {
  switch (dGeomGetClass(geom)) {
    case dSphereClass:
    case dBoxClass:
    case dCapsuleClass:
    case dCylinderClass:
    case dConvexClass:
    case dRayClass:
      return true;
    default:
      return find_body(geom) != nullptr;
  }
}

PosedShape::PosedShape(dGeomID geom) {
  const int number = dGeomGetClass(geom);
  if (number == dRayClass) {
    take_ray(geom);
    return;
  }
  if (!has_shape(geom)) refuse_class(geom);
  pose_ = pose_of(geom);
  switch (number) {
    case dSphereClass:
      keep(sphere_of(geom));
      break;
    case dBoxClass:
      keep(box_of(geom));
      break;
    case dCapsuleClass:
      keep(capsule_of(geom));
      break;
    case dCylinderClass:
      keep(cylinder_of(geom));
      break;
    case dConvexClass:
      take_hull(geom);
      break;
    default:
      shape_ = &require_body(geom).shape();
  }
}

// Vertices that cannot be read are not finite. The core refuses such a pose, too.
void PosedShape::take_hull(dGeomID convex) {
  thread_local ThreadKept<ConvexVertices> kept_vertices;
  thread_local ThreadKept<std::vector<Vector3>> kept_points;
  ConvexVertices& vertices = *kept_vertices;
  std::vector<Vector3>& points = *kept_points;
  points.assign(1, Vector3::Zero());
  if (vertices.read(convex)) {
    const Vector3 middle = pose_.rotation.transpose() * (vertices.pose().position - pose_.position);
    points.assign(vertices.points().begin(), vertices.points().end());
    for (Vector3& point : points) point += middle;
  } else {
    pose_.position.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  keep(Polytope(points));
}

// The rotation of the geom is not read, because dGeomRaySet writes only one column of it.
void PosedShape::take_ray(dGeomID ray) {
  dVector3 start, along;
  dGeomRayGet(ray, start, along);
  pose_.position = to_vector(start);
  ends_ = {Vector3::Zero(), double{dGeomRayGetLength(ray)} * to_vector(along)};
  keep(Polytope(ends_));
}

}  // namespace supernormal::ode
