// Whether derivatives at a pose still hold a little beside it.
#pragma once

#include <array>
#include <cstddef>

#include "proximity/derivatives/tangent_response.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

// rad: derivatives that hold over a smaller rotation only count as not defined. Over 1e-6 the difference of two gaps still has nine
// digits, and poses from a solver or a measurement that are nearer to a kink are usually meant to be on it.
inline constexpr double kNearby = 1e-6;

/// Up to two directions of a tangent plane that span what is special there.
struct TangentDirections {
  std::array<Vector2, 2> unit{};
  int count = 0;

  /// Whether both contain one direction, to within kNearby.
  bool share_one_with(const TangentDirections& other) const;
};

/// How far one body's boundary point moves as its normal rotates by kNearby. A flat body has a kink in its support function: the
/// point jumps across the face. If the other body is flat in the same direction, the gap has the kink, too. If it is round there,
/// the gap has none.
class NearbyFlats {
 public:
  /// `plane` is at the unit normal n of the evaluated `jet`, in the frame of the body, and `curvature` in the basis of `plane`.
  /// `size` (m) is that of the smaller body.
  NearbyFlats(const Shape& shape, const TangentPlane& plane, const Jet& jet, const BodyCurvature& curvature, double size);

  /// Whether the body may be flat somewhere within kNearby. Not if all its radii of curvature are moderate. No evaluation.
  bool is_possible() const { return is_possible_; }

  /// Adds the boundary point r of the normal that is tilted by `tilt` (rad) in the plane.
  void add(const Vector2& tilt, const Vector3& r);

  TangentDirections jumps() const;  ///< along which the point jumps: the support function has a kink
  TangentDirections bends() const;  ///< along which a radius of curvature changes, so that second derivatives are one-sided

 private:
  static constexpr std::size_t kCapacity = 4 + std::size_t{ActiveVertices::kCapacity};

  /// A displacement of the boundary point, beyond what the radii of curvature say.
  struct Displacement {
    Vector2 excess = Vector2::Zero();  // m
    double foreseen = 0;               // m
  };

  void add_vertices(const Shape& shape, const Jet& jet);
  TangentDirections directions(double least, double least_fraction) const;

  const TangentPlane plane_;
  const BodyCurvature curvature_;
  const Vector3 point_;
  const double size_;
  std::array<Displacement, kCapacity> displacements_;
  std::size_t count_ = 0;
  bool is_possible_ = false;
};

}  // namespace supernormal
