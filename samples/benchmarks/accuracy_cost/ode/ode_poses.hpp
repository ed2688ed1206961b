// Poses of a body at a collider.
#pragma once

#include <array>
#include <optional>

#include "common/random.hpp"
#include "ode_bodies.hpp"
#include "supernormal/proximity/pose.hpp"

namespace accuracy_cost {

inline constexpr int kMaxContacts = 16;  // max_contacts of a query

struct OdePair {
  dGeomID body;
  dGeomID collider;

  void move_body(const supernormal::Pose& pose) const;
  int collide(std::array<dContactGeom, kMaxContacts>& contacts) const;
};

/// The approach of a body to its collider, the same for all bodies.
struct Approach {
  supernormal::Matrix3 orientation;  ///< of the body
  supernormal::Vector3 start;        ///< m; of its centre, inside the collider
  supernormal::Vector3 direction;    ///< unit; out of the collider
  supernormal::Matrix3 collider_orientation;
  supernormal::Vector3 ray;  ///< unit; perpendicular to the direction
  supernormal::Pose nudge;   ///< motion of the body between two consecutive poses: 1e-3 m, 1e-3 rad

  static Approach draw(ColliderClass collider, common::Random& random);
  void move_collider(ColliderClass collider, dGeomID geom) const;
  std::array<supernormal::Pose, 2> poses_at(double distance) const;
};

/// The distance from the start of the approach beyond which dCollide finds no contacts of the body. Empty if it never finds any.
std::optional<double> touching_distance(const OdePair& pair, const Approach& approach);

}  // namespace accuracy_cost
