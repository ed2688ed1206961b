// The model of an ascent where body 2 has faces or straight edges.
#pragma once

#include <array>
#include <span>

#include "proximity/tangent_plane.hpp"

namespace supernormal {

/// One smooth piece of the gap function: value + slope.u, before curvature.
struct Piece {
  double value;   ///< m
  Vector2 slope;  ///< m

  double at(const Vector2& u) const { return value + slope.dot(u); }
};

/// The lowest value at u = 0, m; infinite where there is no piece. Pieces meet there where they are as low as this: their values
/// themselves are relative to the support function, another sum than theirs, from which each may differ by rounding of its own.
double lowest_value(std::span<const Piece> pieces);

/// gain(u) = min over the pieces of (value + slope.u) - 1/2 u.A u over the tangent plane: concave where A is, with kinks where two
/// pieces meet. Its maximum lies on one piece (a corner of body 2 touches), where two meet (an edge) or where three meet (a face).
struct PiecewiseModel {
  std::span<const Piece> pieces;  ///< where there is none, nothing bounds the gain
  Symmetric2 A;                   ///< m; the same for all pieces

  struct Peak {
    Vector2 u = Vector2::Zero();
    double gain = 0;                        ///< m; at u
    std::array<std::size_t, 3> active{};    ///< the pieces that meet there
    std::array<double, 3> weight{1, 0, 0};  ///< sum of weight * slope = A u: the share of each in the contact point
    std::size_t count = 1;                  ///< of active pieces; 0 without any piece, and then the gain is infinite
  };

  /// The maximum over the whole plane; A must be positive definite. An active-set method: the maximum over a subset of the pieces
  /// is corrected by the piece that lies lowest there, until none lies lower. Each maximum is lower than the one before, so it
  /// ends.
  Peak maximize() const;

  /// The maximum over |u| <= radius, or near it: that of the model with A + shift I, the least shift (up to a tenth of |u|) that
  /// makes it positive definite and u as short as that. The active pieces meet at u exactly, whatever the shift.
  Peak maximize(double radius) const;
};

}  // namespace supernormal
