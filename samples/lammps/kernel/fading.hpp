// How far a flat contact counts.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/face.hpp"

namespace granular {

// Faces and sides count in full if they overlap in this fraction of a square as wide as the narrower one. Bodies that overlap with
// their edges only, in two directions, have less: there the nearest face may change.
constexpr double kFullOverlap = 0.2;

/// A function that is 0 up to 0 and 1 from 1 on, with its slope.
struct Ramp {
  double value, slope;

  explicit Ramp(double x) {
    const double t = std::clamp(x, 0.0, 1.0);
    value = t * t * (3 - 2 * t);
    slope = 6 * t * (1 - t);
  }
};

/// How much two faces with these outward normals count, and its derivative by a rotation of body 1. For sides: two opposite axes.
struct Tilt {
  double share = 0;
  Vector3 by_turn = Vector3::Zero();

  Tilt(const Vector3& normal1, const Vector3& normal2, double largest) {
    const double cosine = -normal1.dot(normal2);
    if (!(cosine > std::cos(2 * largest))) return;
    const Vector3 axis = normal1.cross(normal2);
    const double sine = axis.norm(), angle = std::atan2(sine, cosine);
    const Ramp ramp(angle / largest - 1);
    share = 1 - ramp.value;
    if (ramp.slope > 0) by_turn = -ramp.slope / largest / sine * axis;
  }
};

}  // namespace granular
