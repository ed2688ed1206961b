// A proved separation after a motion: pairs that cannot have met need no query.
#pragma once

#include "supernormal/export.h"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The gap function at one normal n, as a query found it, and the relative pose that it belongs to. In body 1's frame. Such a
/// Separation says nothing about bodies that change their shape.
struct Separation {
  Vector3 normal;       ///< unit
  double gap;           ///< m; s(n): > 0 proves separation
  Vector3 offset;       ///< m; from body 1's origin to body 2's
  Vector3 normal_in_2;  ///< n in body 2's frame
};

/// m; a lower bound of s(n) at another relative pose (`offset`, `normal_in_2`). If it is positive, n still separates the bodies.
/// radius1, radius2: Shape::bounding_radius(), m. A support function changes by no more than this radius times the change of its
/// argument, so s changes by at least n . (c' - c) - radius2 |R'^T n - R^T n|. Rounding errors are subtracted. NaN if an argument
/// is.
SUPERNORMAL_API double least_gap_after(const Separation& then, const Vector3& offset, const Vector3& normal_in_2, double radius1,
                                       double radius2);

}  // namespace supernormal
