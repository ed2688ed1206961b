// The numbers of ellipsoids and superellipsoids for queries in lanes.
#pragma once

#include <typeinfo>

#include "supernormal/shapes/ellipsoid.hpp"
#include "supernormal/shapes/lane_body.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace supernormal {

/// The numbers of a shape with these half-axes (m) and exponents. Only the shape's radii are read.
LaneBody make_lane_body(const Shape& shape, const Vector3& half_axes, double delta, double epsilon);

class LaneBodies {
 public:
  /// The numbers of the shape, or null if it is no ellipsoid or superellipsoid. Every query asks, so it compares addresses.
  static const LaneBody* of(const Shape& shape) {
    const std::type_info* const type = &typeid(shape);
    if (type == &typeid(Superellipsoid)) return &static_cast<const Superellipsoid&>(shape).numbers_;
    if (type == &typeid(Ellipsoid)) return &static_cast<const Ellipsoid&>(shape).numbers_;
    return nullptr;
  }
};

}  // namespace supernormal
