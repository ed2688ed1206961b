#include "ode/colliders/convex/posed_shape.hpp"

#include <cstdint>
#include <limits>
#include <vector>

#include "base/thread_kept.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/convex_vertices.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"

namespace supernormal::ode {

bool has_shape(dGeomID geom) {
  const int number = dGeomGetClass(geom);
  return number == dConvexClass || number == dRayClass || find_primitive(number) != nullptr || find_body(geom) != nullptr;
}

PosedShape::PosedShape(dGeomID geom) {
  const int number = dGeomGetClass(geom);
  if (number == dRayClass) {
    take_ray(geom);
    return;
  }
  if (!has_shape(geom)) refuse_class(geom);
  pose_ = pose_of(geom);
  std::uint32_t kind = 0;
  if (const Primitive* const primitive = find_primitive(number)) {
    shape_ = &primitive->make(geom, kept_, kind);
  } else if (number == dConvexClass) {
    take_hull(geom);
  } else {
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
  shape_ = &kept_.emplace<Polytope>(points);
}

// The rotation of the geom is not read, because dGeomRaySet writes only one column of it.
void PosedShape::take_ray(dGeomID ray) {
  dVector3 start, along;
  dGeomRayGet(ray, start, along);
  pose_.position = to_vector(start);
  ends_ = {Vector3::Zero(), double{dGeomRayGetLength(ray)} * to_vector(along)};
  shape_ = &kept_.emplace<Polytope>(ends_);
}

}  // namespace supernormal::ode
