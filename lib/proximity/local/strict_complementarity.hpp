// Which corners that share a normal hold it.
#pragma once

#include <span>

#include "proximity/local/piecewise_model.hpp"

namespace supernormal {

/// Where corners of body 2 meet, on an edge or a face, s has a kink there: it falls to either side, whatever its curvature. But
/// only where the point of body 1 is between them.
class StrictComplementarity {
 public:
  /// `rounding`, `length_unit`: m
  StrictComplementarity(double rounding, double length_unit) : rounding_(rounding), length_unit_(length_unit) {}

  /// Whether all the pieces that meet at a peak hold it, for a model of this curvature.
  bool is_held(const PiecewiseModel::Peak& peak, std::span<const Piece> pieces, const Symmetric2& A) const;

  /// The curvature that matters for the pieces here.
  Symmetric2 reduced_hessian(const Symmetric2& A, std::span<const Piece> pieces) const;

 private:
  /// Of pieces that meet, those that hold the normal.
  PiecewiseModel::Peak holding(std::span<const Piece> tied) const;

  double rounding_, length_unit_;
};

}  // namespace supernormal
