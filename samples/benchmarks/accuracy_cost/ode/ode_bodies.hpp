// The bodies whose queries are timed, and the colliders of all of ODE's classes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ode_geom.hpp"

namespace accuracy_cost {

/// Fits into half-axes 0.5, 0.4, 0.3 m.
struct OdeBody {
  std::string name;
  OdeGeom (*make)();
  bool is_warm;  ///< ours, started from the last normal of the pair; the others do not know such a thing
};

inline constexpr double kSmallestHalfAxis = 0.3;  // m

/// Ours and those of ODE's that a program would take instead, with a convex of 960 triangles among them.
std::vector<OdeBody> ode_bodies();

/// Places of ode_bodies() that are compared.
inline constexpr std::size_t kOursCold = 0, kOursWarm = 1;
inline constexpr std::array<std::size_t, 3> kOthers = {4, 5, 6};

enum class ColliderClass { Plane, Sphere, Box, Capsule, Cylinder, Convex, Trimesh, Ray, Itself };
inline constexpr std::array kColliderClasses = {ColliderClass::Plane,   ColliderClass::Sphere,   ColliderClass::Box,
                                                ColliderClass::Capsule, ColliderClass::Cylinder, ColliderClass::Convex,
                                                ColliderClass::Trimesh, ColliderClass::Ray,      ColliderClass::Itself};

std::string name_of(ColliderClass collider);

/// A collider of this class; for Itself another of `body`.
OdeGeom make_collider(ColliderClass collider, const OdeBody& body);

}  // namespace accuracy_cost
