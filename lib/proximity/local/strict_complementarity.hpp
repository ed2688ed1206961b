// Which of the vertices tied at a normal have a positive multiplier (strict complementarity).
#pragma once

#include <span>

#include "proximity/local/piecewise_model.hpp"

namespace supernormal {

/// If vertices of body 2 are tied at a normal, on an edge or a face, s is nonsmooth there. It decreases to both sides, whatever its
/// curvature, but only if the point of body 1 is between these vertices.
class StrictComplementarity {
 public:
  /// `rounding` and `length_unit` in m.
  StrictComplementarity(double rounding, double length_unit) : rounding_(rounding), length_unit_(length_unit) {}

  /// Whether all pieces that meet at the peak have positive multipliers, for a model with the curvature A.
  bool is_strict(const PiecewiseModel::Peak& peak, std::span<const Piece> pieces, const Symmetric2& A) const;

  /// The curvature with A replaced across the directions in which the pieces tied at u = 0 determine the normal.
  Symmetric2 reduced_hessian(const Symmetric2& A, std::span<const Piece> pieces) const;

 private:
  /// Of the tied pieces, those with positive multipliers.
  PiecewiseModel::Peak with_positive_multipliers(std::span<const Piece> tied) const;

  double rounding_, length_unit_;
};

}  // namespace supernormal
