// How ODE's colliders are asked: a geom at another.
#pragma once

#include <ode/ode.h>

#include <array>

#include "supernormal/proximity/pose.hpp"

namespace accuracy_cost {

inline constexpr int kMaxContacts = 16;  // max_contacts of a query

/// Writes a rotation in rows of four, the layout of ODE.
inline void set_rotation(dGeomID geom, const supernormal::Matrix3& rotation) {
  dMatrix3 matrix{};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix[4 * row + column] = rotation(row, column);
  }
  dGeomSetRotation(geom, matrix);
}

struct OdePair {
  dGeomID body;
  dGeomID collider;

  void move_body(const supernormal::Pose& pose) const {
    dGeomSetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
    set_rotation(body, pose.rotation);
    // A space does this before dCollide. The ODE collider of dConvex and dTriMesh uses the last computed box.
    dReal aabb[6];
    dGeomGetAABB(body, aabb);
  }
  int collide(std::array<dContactGeom, kMaxContacts>& contacts) const {
    return dCollide(body, collider, kMaxContacts, contacts.data(), sizeof(dContactGeom));
  }
};

}  // namespace accuracy_cost
