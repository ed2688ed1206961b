// The bodies whose queries are timed, colliders of all geometry classes of ODE, and poses of the one at the other.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/ode_geom.hpp"
#include "common/random.hpp"
#include "supernormal/proximity/pose.hpp"

namespace accuracy_cost {

/// A body that fits into half-axes 0.5, 0.4, 0.3 m.
struct OdeBody {
  std::string name;
  common::OdeGeom (*make)();
  bool is_warm;  ///< ours, with a warm start; the other classes have none
};

inline constexpr double kSmallestHalfAxis = 0.3;  // m

/// Our bodies and the ODE bodies that a program would use instead, including a convex of 960 triangles.
std::vector<OdeBody> ode_bodies();

/// Indices of the compared entries of ode_bodies().
inline constexpr std::size_t kOursCold = 0, kOursWarm = 1;
inline constexpr std::array<std::size_t, 3> kOthers = {4, 5, 6};

enum class ColliderClass { Plane, Sphere, Box, Capsule, Cylinder, Convex, Trimesh, Ray, Itself };
inline constexpr std::array kColliderClasses = {ColliderClass::Plane,   ColliderClass::Sphere,   ColliderClass::Box,
                                                ColliderClass::Capsule, ColliderClass::Cylinder, ColliderClass::Convex,
                                                ColliderClass::Trimesh, ColliderClass::Ray,      ColliderClass::Itself};

const char* name_of(ColliderClass collider);

/// A collider of this class. For Itself it is a copy of `body`.
common::OdeGeom make_collider(ColliderClass collider, const OdeBody& body);

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
