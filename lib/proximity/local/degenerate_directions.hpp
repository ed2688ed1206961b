// Where the radius of curvature tells nothing of the normals nearby.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "proximity/local/local_model.hpp"

namespace supernormal {

/// A radius of curvature beyond this, in units of the bodies' size, is that of a flat face.
inline constexpr double kFlatRadius = 1e8;

/// The ways (unit, gnomonic) that lead across flat spots of the bodies near the normal of a model: closer than `distance`
/// (gnomonic).
///
/// At the normal of a flat spot the radius of curvature is infinite, however fast it falls beside it: one of exponent 2.3 may hold
/// the normal for 1e-5 radians only, one of 2.03 does not even look flat. Our own shapes have theirs on the planes of symmetry;
/// those of others are told by the radius alone.
class DegenerateDirections {
 public:
  DegenerateDirections(const GapFunction& gap, const LocalModel& local, double distance);

  std::span<const Vector2> ways() const { return {ways_.data(), count_}; }

 private:
  void add_planes(const Shape& shape, const TangentPlane& plane, double distance);
  void add(const Vector2& way) { ways_[count_++] = way; }

  std::array<Vector2, 8> ways_;  // two by their radii, and three planes of each body
  std::size_t count_ = 0;
};

}  // namespace supernormal
