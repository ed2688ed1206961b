// The bodies whose queries are timed, and the colliders of all of ODE's classes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ode_geom.hpp"

namespace accuracy_cost {

/// A body that fits into half-axes 0.5, 0.4, 0.3 m.
struct OdeBody {
  std::string name;
  OdeGeom (*make)();
  bool is_warm;  ///< ours, started from the last normal of the pair; the other classes have no warm start
};

inline constexpr double kSmallestHalfAxis = 0.3;  // m

/// Our bodies and those of ODE's classes that a program would use instead, with a convex of 960 triangles among them.
std::vector<OdeBody> ode_bodies();

/// Indices of those of ode_bodies() that are compared.
inline constexpr std::size_t kOursCold = 0, kOursWarm = 1;
inline constexpr std::array<std::size_t, 3> kOthers = {4, 5, 6};

enum class ColliderClass { Plane, Sphere, Box, Capsule, Cylinder, Convex, Trimesh, Ray, Itself };
inline constexpr std::array kColliderClasses = {ColliderClass::Plane,   ColliderClass::Sphere,   ColliderClass::Box,
                                                ColliderClass::Capsule, ColliderClass::Cylinder, ColliderClass::Convex,
                                                ColliderClass::Trimesh, ColliderClass::Ray,      ColliderClass::Itself};

std::string name_of(ColliderClass collider);

/// A collider of this class; for Itself it is another of `body`.
OdeGeom make_collider(ColliderClass collider, const OdeBody& body);

}  // namespace accuracy_cost
