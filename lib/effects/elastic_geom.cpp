#include "effects/elastic_geom.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "ode/colliders/convex/posed_shape.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "supernormal/contact/contact_curvature.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace supernormal::effects {
namespace {

constexpr double kWall = 1e-3;  // sine of the largest angle between the wall's normal and the cross-section

Matrix3 curvature_of_wall(double radius, const Vector3& axis, const Vector3& n) {
  const Vector3 around = axis.cross(n).normalized();
  return around * around.transpose() / radius;
}

Vector3 axis_of(dGeomID geom) {
  const Matrix3 rotation = ode::to_rotation(dGeomGetRotation(geom));
  return rotation.col(2);
}

/// Of the bounding box in the frame of the world, which changes as the geom turns.
double mean_half_width_of_box(dGeomID geom) {
  dReal box[6];
  dGeomGetAABB(geom, box);
  const double sum = double{box[1]} - box[0] + box[3] - box[2] + box[5] - box[4];
  return std::isfinite(sum) ? sum / 6 : std::numeric_limits<double>::infinity();
}

/// Of the bounding box in the frame of the mesh.
double mean_half_width_of_mesh(dGeomID mesh) {
  const dGeomID level = dCreateTriMesh(nullptr, dGeomTriMeshGetTriMeshDataID(mesh), nullptr, nullptr, nullptr);
  const double width = mean_half_width_of_box(level);
  dGeomDestroy(level);
  return width;
}

}  // namespace

Matrix3 curvature_of(dGeomID geom, const Vector3& n) {
  if (const ode::Body* const body = ode::find_body(geom)) return find_curvature(body->shape(), ode::pose_of(geom), n);
  dReal radius = 0;
  dReal length = 0;
  switch (dGeomGetClass(geom)) {
    case dSphereClass:
      return find_curvature(Sphere(dGeomSphereGetRadius(geom)), {}, n);
    case dCapsuleClass: {
      dGeomCapsuleGetParams(geom, &radius, &length);
      const Vector3 axis = axis_of(geom);
      return std::abs(axis.dot(n)) < kWall ? curvature_of_wall(radius, axis, n) : find_curvature(Sphere(radius), {}, n);
    }
    case dCylinderClass: {
      dGeomCylinderGetParams(geom, &radius, &length);
      const Vector3 axis = axis_of(geom);
      return std::abs(axis.dot(n)) < kWall ? curvature_of_wall(radius, axis, n) : Matrix3(Matrix3::Zero());
    }
    default:
      return Matrix3::Zero();
  }
}

double mean_half_extent(dGeomID geom) {
  if (dGeomGetClass(geom) == dTriMeshClass) return mean_half_width_of_mesh(geom);
  if (!ode::has_shape(geom)) return mean_half_width_of_box(geom);
  try {
    return ode::PosedShape(geom).shape().half_extents().mean();
  } catch (const std::invalid_argument&) {  // a dConvex that was changed without dGeomMoved
    return mean_half_width_of_box(geom);
  }
}

}  // namespace supernormal::effects
