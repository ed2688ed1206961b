// Springs and dampers as rows of ODE's solver, and attraction.
//
// A row with softness cfm and target velocity u enforces v + cfm f = u, where v is the velocity after the step. So its force is
// f = A - B v with B = 1 / cfm and A = B u. ODE's soft ERP and CFM make this the implicit Euler method. Here A is the force at the
// start of the step, and B is only the implicit half of the damper. ODE moves positions with the new velocity. So this is the
// leapfrog method, which adds no damping. Let m be the mass of the contact and s = h^2 k / m. Leapfrog is stable for s < 4, and a
// contact lasts pi / sqrt(s) steps.
//
// With A - theta h k v the method goes from leapfrog (theta = 0) to implicit Euler (theta = 1). It is stable for
// s (1 - 2 theta) < 4, and damps by 1 / (1 + theta s) a step. theta = (s - limit) / (s + 1) becomes positive where a contact lasts
// ten steps. It is stable for any s, also for a body with ten such contacts at once. No impact gains more than 0.5 %, wherever in a
// step it begins.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "effects/motion.hpp"
#include "effects/pair_material.hpp"
#include "ode/colliders/convex/posed_shape.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "supernormal/contact/contact_curvature.hpp"
#include "supernormal/contact/hertz.hpp"
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

/// The curvature tensor of the geom's boundary at the point with outward unit normal n (world frame), 1/m. Among ODE's own geoms
/// dSphere, dCapsule and dCylinder are curved. All others count as flat. Their edges do too, because Hertz's theory does not cover
/// edges.
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

/// m; the mean half-extent of a geom in its own frame, however it is turned; infinite for an unbounded one. Of a class that only
/// has a bounding box in the frame of the world (dGeomTransform, dHeightfield) it is that of the box.
double mean_half_extent(dGeomID geom) {
  if (dGeomGetClass(geom) == dTriMeshClass) return mean_half_width_of_mesh(geom);
  if (!ode::has_shape(geom)) return mean_half_width_of_box(geom);
  try {
    return ode::PosedShape(geom).shape().half_extents().mean();
  } catch (const std::invalid_argument&) {  // a dConvex that was changed without dGeomMoved
    return mean_half_width_of_box(geom);
  }
}

// A contact lasts half a period of the spring.
constexpr double kStiffest = (std::numbers::pi / kLeastContactSteps) * (std::numbers::pi / kLeastContactSteps);
// Least B, in mass / step. The row is then as good as rigid, and ODE's solver can still divide by B.
constexpr double kLeastDamper = 1e-6;

struct Spring {
  double force;    ///< N, at the largest depth
  double tangent;  ///< N/m
  double damping;  ///< N s/m
};

/// kg; the effective mass of the contact at the point where the spring's force acts, the depth-weighted mean of the contacts.
double effective_mass(const Patch& patch) {
  const Vector3 point = patch.centre_of_depth();
  const Vector3 n = patch.normal();
  const double mobilities = mobility(patch.body1, point, n) + mobility(patch.body2, point, n);
  return mobilities > 0 ? 1 / mobilities : 0;
}

/// Moves contacts that carry no force behind the others.
void leave_out_idle(double damping, Patch& patch) {
  if (damping > 0) return;
  patch.kept = static_cast<int>(move_to_front(patch.contacts, [](const dContact& contact) { return contact.geom.depth > 0; }));
}

void set_rows(const Spring& spring, double mass, Patch& patch) {
  const double h = patch.step;
  double depths = 0;
  for (const dContact& contact : patch.contacts) depths += contact.geom.depth;
  const double stiffness = mass > 0 ? h * h * spring.tangent / mass : 0;
  const double implicit = std::max(0.0, (stiffness - kStiffest) / (stiffness + 1));
  if (implicit > 0) patch.coarse = patch.kept;
  // A stronger damper would reverse the velocity within the step. It is made fully implicit.
  const double new_half = spring.damping * h > 2 * mass ? 1 - mass / (spring.damping * h) : 0.5;
  const Vector3 n = patch.normal();
  for (std::size_t k = 0; k < patch.contacts.size(); ++k) {
    dContact& contact = patch.contacts[k];
    const Vector3 point = ode::to_vector(contact.geom.pos);
    const double velocity = n.dot(velocity_at(patch.body1, point) - velocity_at(patch.body2, point));
    const double share = depths > 0 ? contact.geom.depth / depths : 0;
    const double damper = spring.damping > 0 ? patch.fraction_at(k) * spring.damping : 0;
    const double A = share * spring.force - (1 - new_half) * damper * velocity;
    const double B = std::max(share * implicit * h * spring.tangent + new_half * damper, kLeastDamper * mass / h);
    contact.surface.soft_cfm = ode::to_real(B > 0 ? 1 / B : 0);
    contact.surface.motionN = ode::to_real(B > 0 ? A / B : 0);
  }
  leave_out_idle(spring.damping, patch);
}

constexpr double kLayer = 1e-4;  // the depth at which rigid contacts stick, relative to the mean half-extent

// ODE pushes rigid contacts apart to depth 0, where rounding would separate the bodies. So each rigid contact that sticks is only
// pushed to a layer of this depth. It may sink deeper into the layer.
void keep_in_touch(Patch& patch) {
  const double layer = kLayer * std::min(mean_half_extent(patch.geom1()), mean_half_extent(patch.geom2()));
  const dBodyID body = patch.body1 != nullptr ? patch.body1 : patch.body2;
  const double erp_of_world = dWorldGetERP(dBodyGetWorld(body));
  for (dContact& contact : patch.contacts) {
    const double erp = (contact.surface.mode & dContactSoftERP) != 0 ? double{contact.surface.soft_erp} : erp_of_world;
    contact.surface.motionN = ode::to_real(-erp / patch.step * layer);
  }
}

}  // namespace

void set_spring(const PairMaterial& pair, Patch& patch) {
  const double depth = patch.greatest_depth();
  set_rows({pair.stiffness * depth, pair.stiffness, pair.damping}, effective_mass(patch), patch);
}

void set_hertz(const PairMaterial& pair, Patch& patch) {
  const Vector3 n = patch.normal();
  const dGeomID geom1 = patch.geom1();
  const dGeomID geom2 = patch.geom2();
  const ContactCurvature curvature = find_contact_curvature(curvature_of(geom1, -n) + curvature_of(geom2, n), n);
  const double depth = patch.greatest_depth();
  const double width = std::min(mean_half_extent(geom1), mean_half_extent(geom2));
  Spring spring{2 * pair.elastic_modulus * width * depth, 2 * pair.elastic_modulus * width, 0};  // the force of the flat punch
  // Beyond an aspect ratio of a thousand, Hertz's ellipse counts as a line contact.
  const double smaller = std::max(curvature.smaller, 1e-6 * curvature.larger);
  if (smaller > 0 && depth > 0) {
    const double radius = 1 / std::sqrt(smaller * curvature.larger);
    const double reduced = depth / hertz_correction(curvature.larger / smaller);
    const double force = 4.0 / 3 * pair.elastic_modulus * std::sqrt(radius * reduced) * reduced;
    if (force < spring.force) spring = {force, 1.5 * force / depth, 0};
  }
  const double mass = effective_mass(patch);
  spring.damping = 2 * pair.damping_ratio * std::sqrt(5.0 / 6 * mass * spring.tangent);
  set_rows(spring, mass, patch);
}

// A contact joint cannot pull. So the attraction is an external force, and the joint carries the reaction.
void add_adhesion(const PairMaterial& pair, Patch& patch) {
  const dBodyID body1 = patch.body1;
  const dBodyID body2 = patch.body2;
  const auto is_awake = [](dBodyID body) { return body != nullptr && dBodyIsEnabled(body) != 0; };
  // ODE would keep the forces on a sleeping body until it wakes.
  if (!is_awake(body1) && !is_awake(body2)) return;
  if ((pair.surface.mode & dContactSoftCFM) == 0) keep_in_touch(patch);
  const Vector3 pull = -pair.pull_off * patch.normal();
  const Vector3 point = patch.middle();
  add_force(body1, pull, point);
  add_force(body2, -pull, point);
}

}  // namespace supernormal::effects
