#include "ode_poses.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "random_geometry.hpp"

namespace accuracy_cost {

using common::Random;
using supernormal::Matrix3;
using supernormal::Pose;
using supernormal::Vector3;

namespace {

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
