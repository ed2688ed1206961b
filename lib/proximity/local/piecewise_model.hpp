// The model of an ascent if body 2 has faces or straight edges.
#pragma once

#include <array>
#include <span>

#include "base/tangent_plane.hpp"

namespace supernormal {

/// One smooth piece of the gap function: value + slope.u, without the curvature.
struct Piece {
  double value;   ///< m
  Vector2 slope;  ///< m

  double at(const Vector2& u) const { return value + slope.dot(u); }
};

/// m; the lowest value at u = 0; infinite if there is no piece. Pieces with this value meet there. The values are relative to the
/// support function, which is a different sum. So each may differ from 0 by rounding.
double lowest_value(std::span<const Piece> pieces);

/// gain(u) = min over the pieces of (value + slope.u) - 1/2 u.A u over the tangent plane. It is concave where A is positive
/// semidefinite, with nonsmooth points where pieces meet. Its maximum is on one piece (a vertex of body 2 touches), where two meet
/// (an edge) or where three meet (a face).
struct PiecewiseModel {
  std::span<const Piece> pieces;  ///< without any piece, nothing bounds the gain
  Symmetric2 A;                   ///< m; the same for all pieces

  struct Peak {
    Vector2 u = Vector2::Zero();
    double gain = 0;                        ///< m; at u
    std::array<std::size_t, 3> active{};    ///< the pieces that meet there
    std::array<double, 3> weight{1, 0, 0};  ///< sum of weight * slope = A u: the multipliers, and the weights of the contact point
    std::size_t count = 1;                  ///< number of active pieces; 0 without any piece, and then the gain is infinite
  };

  /// The maximum over the whole plane; A must be positive definite. This is an active-set method. The piece that is lowest at the
  /// maximum of a subset joins the subset, until no piece is lower. Each maximum is lower than the one before, so the method ends.
  Peak maximize() const;

  /// The maximum over |u| <= radius, approximately. It is the maximum of the model with A + shift I. The shift is the least (up to
  /// a tenth of |u|) that makes this matrix positive definite and u short enough. The active pieces meet at u exactly, whatever the
  /// shift.
  Peak maximize(double radius) const;
};

}  // namespace supernormal
