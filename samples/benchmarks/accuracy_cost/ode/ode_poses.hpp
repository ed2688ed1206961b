// Poses of a body at a collider.
#pragma once

#include <array>
#include <optional>

#include "base/random.hpp"
#include "ode_bodies.hpp"
#include "supernormal/proximity/pose.hpp"

namespace accuracy_cost {

inline constexpr int kMaxContacts = 16;  // room for the contacts of a query

struct OdePair {
  dGeomID body;
  dGeomID collider;

  void move_body(const supernormal::Pose& pose) const;
  int collide(std::array<dContactGeom, kMaxContacts>& contacts) const;
};

/// The way in which a body approaches its collider; the same for all bodies.
struct Approach {
  supernormal::Matrix3 attitude;   ///< attitude of the body
  supernormal::Vector3 start;      ///< m; start of its centre, inside the collider
  supernormal::Vector3 direction;  ///< unit; direction out of the collider
  supernormal::Matrix3 collider_attitude;
  supernormal::Vector3 ray;  ///< unit; perpendicular to the direction
  supernormal::Pose nudge;   ///< motion of the body between two poses that follow one another: 1e-3 m, 1e-3 rad

  static Approach draw(ColliderClass collider, falling_particles::Random& random);
  void move_collider(ColliderClass collider, dGeomID geom) const;
  std::array<supernormal::Pose, 2> poses_at(double distance) const;
};

/// The distance from the start of the approach at which dCollide finds no more contacts of the body; empty if it finds none
/// anywhere.
std::optional<double> touching_distance(const OdePair& pair, const Approach& approach);

}  // namespace accuracy_cost
