// The bodies whose queries are timed, and colliders of all geometry classes of ODE.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/ode_geom.hpp"

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

std::string name_of(ColliderClass collider);

/// A collider of this class. For Itself it is a copy of `body`.
common::OdeGeom make_collider(ColliderClass collider, const OdeBody& body);

}  // namespace accuracy_cost
