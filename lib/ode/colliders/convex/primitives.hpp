// The classes of ODE that are shapes of the core by their lengths.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <span>
#include <variant>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "supernormal/shapes/sphere.hpp"

namespace supernormal::ode {

/// Holds the shape of a convex geom of ODE.
using KeptShape = std::variant<std::monostate, Sphere, Box, Capsule, Cylinder, Polytope>;

/// A class of ODE.
struct Primitive {
  int geom_class;
  /// The shape of a geom, which `kept` holds. `kind`: collider_kind() of its class and of the lengths on which its normals depend.
  const Shape& (*make)(dGeomID geom, KeptShape& kept, std::uint32_t& kind);
};

/// All of them: the queries of these classes, their derivatives and times of impact follow.
std::span<const Primitive> primitives();

/// Null for other classes.
const Primitive* find_primitive(int geom_class);

}  // namespace supernormal::ode
