#include "colliders.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "pairs.hpp"
#include "supernormal/supernormal.h"

namespace accuracy_cost {

namespace {

using common::icosahedron;
using common::make_convex;
using common::make_trimesh;
using common::MeshSize;
using common::OdeGeom;
using common::Random;
using common::superellipsoid_mesh;
using common::terrain;
using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Vector3;

constexpr double kA = 0.5, kB = 0.4, kC = kSmallestHalfAxis;
constexpr double kExponent = 4;
constexpr MeshSize kConvexSize{24, 20};  // 960 triangles, 482 vertices
constexpr unsigned kTerrainCells = 40;   // 3200 triangles

OdeGeom superellipsoid() { return OdeGeom(snCreateSuperellipsoid(nullptr, kA, kB, kC, kExponent, kExponent)); }
OdeGeom ellipsoid() { return OdeGeom(snCreateEllipsoid(nullptr, kA, kB, kC)); }
OdeGeom box() { return OdeGeom(dCreateBox(nullptr, 2 * kA, 2 * kB, 2 * kC)); }
OdeGeom capsule() { return OdeGeom(dCreateCapsule(nullptr, kC, 2 * (kA - kC))); }
OdeGeom convex() {
  return make_convex(superellipsoid_mesh(supernormal::Vector3(kA, kB, kC), kExponent, kExponent, 0, kConvexSize));
}

struct Collider {
  const char* name;
  OdeGeom (*make)();
};
constexpr std::array<Collider, kColliderClasses.size()> kColliders = {
    {{"dPlane", [] { return OdeGeom(dCreatePlane(nullptr, 0, 0, 1, 0)); }},
     {"dSphere", [] { return OdeGeom(dCreateSphere(nullptr, 0.4)); }},
     {"dBox", [] { return OdeGeom(dCreateBox(nullptr, 0.8, 0.6, 1.0)); }},
     {"dCapsule", [] { return OdeGeom(dCreateCapsule(nullptr, 0.3, 0.5)); }},
     {"dCylinder", [] { return OdeGeom(dCreateCylinder(nullptr, 0.35, 0.7)); }},
     {"dConvex of 20 triangles", [] { return make_convex(icosahedron(0.5)); }},
     {"dTriMesh of 3200 triangles", [] { return make_trimesh(terrain(kTerrainCells, 0.25, 0.05)); }},
     {"dRay", [] { return OdeGeom(dCreateRay(nullptr, 4)); }},
     {"another of the same", nullptr}}};

constexpr double kNudge = 1e-3;       // m and rad
constexpr double kTerrainReach = 2;   // m; bodies are scattered over this range
constexpr double kFar = 3;            // m; nothing collides at this distance
constexpr double kSearchStep = 0.02;  // m
constexpr int kBisections = 40;

/// Writes a rotation in rows of four, the layout of ODE.
void set_rotation(dGeomID geom, const Matrix3& rotation) {
  dMatrix3 matrix{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix[4 * row + column] = rotation(row, column);
  }
  dGeomSetRotation(geom, matrix);
}

bool stands_level(ColliderClass collider) { return collider == ColliderClass::Plane || collider == ColliderClass::Trimesh; }

}  // namespace

std::vector<OdeBody> ode_bodies() {
  return {{"superellipsoid 4, cold", superellipsoid, false},
          {"superellipsoid 4, warm", superellipsoid, true},
          {"ellipsoid, cold", ellipsoid, false},
          {"ellipsoid, warm", ellipsoid, true},
          {"dBox", box, false},
          {"dCapsule", capsule, false},
          {"dConvex 960", convex, false}};
}

const char* name_of(ColliderClass collider) { return kColliders[static_cast<std::size_t>(collider)].name; }

OdeGeom make_collider(ColliderClass collider, const OdeBody& body) {
  return collider == ColliderClass::Itself ? body.make() : kColliders[static_cast<std::size_t>(collider)].make();
}

void OdePair::move_body(const Pose& pose) const {
  dGeomSetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  set_rotation(body, pose.rotation);
  // A space does this before dCollide. The ODE collider of dConvex and dTriMesh uses the last computed box.
  dReal aabb[6];
  dGeomGetAABB(body, aabb);
}

int OdePair::collide(std::array<dContactGeom, kMaxContacts>& contacts) const {
  return dCollide(body, collider, kMaxContacts, contacts.data(), sizeof(dContactGeom));
}

Approach Approach::draw(ColliderClass collider, Random& random) {
  Approach approach;
  approach.orientation = random_orientation(random);
  approach.collider_orientation = random_orientation(random);
  const Vector3 anywhere = random_normal(random);
  approach.direction = stands_level(collider) ? Vector3(Vector3::UnitZ()) : anywhere;
  approach.ray = anywhere.unitOrthogonal();
  approach.start.setZero();
  if (stands_level(collider)) {
    for (const int axis : {0, 1}) approach.start[axis] = uniform(random, -kTerrainReach, kTerrainReach);
  }
  approach.nudge.position = kNudge * random_normal(random);
  approach.nudge.rotation = Eigen::AngleAxisd(kNudge, random_normal(random)).toRotationMatrix();
  return approach;
}

void Approach::move_collider(ColliderClass collider, dGeomID geom) const {
  if (stands_level(collider)) return;
  if (collider == ColliderClass::Ray) {
    const Vector3 origin = -0.5 * dGeomRayGetLength(geom) * ray;
    dGeomRaySet(geom, origin.x(), origin.y(), origin.z(), ray.x(), ray.y(), ray.z());
  } else {
    set_rotation(geom, collider_orientation);
  }
}

std::array<Pose, 2> Approach::poses_at(double distance) const {
  const Vector3 position = start + distance * direction;
  return {Pose{position, orientation}, Pose{position + nudge.position, nudge.rotation * orientation}};
}

std::optional<double> touching_distance(const OdePair& pair, const Approach& approach) {
  std::array<dContactGeom, kMaxContacts> contacts;
  const auto collides = [&](double distance) {
    pair.move_body(approach.poses_at(distance)[0]);
    return pair.collide(contacts) > 0;
  };
  int steps = static_cast<int>(kFar / kSearchStep);
  while (steps >= 0 && !collides(steps * kSearchStep)) --steps;
  if (steps < 0) return std::nullopt;
  double touching = steps * kSearchStep;
  double apart = touching + kSearchStep;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (touching + apart);
    (collides(middle) ? touching : apart) = middle;
  }
  return touching;
}

}  // namespace accuracy_cost
