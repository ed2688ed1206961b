// Compares a fit with the body that its data come from.
#pragma once

#include <array>

#include "model/fit_body.hpp"
#include "truth.hpp"

namespace fit {

/// A fit in the frame of the truth, with its standard errors in that frame.
struct Compared {
  Body body;
  Gradient deviation = Gradient::Zero();       ///< of `body` from the truth, as in fit::deviation
  Gradient standard_error = Gradient::Zero();  ///< as in Uncertainty::standard_error
  std::array<bool, kParameters> is_determined{};
  bool is_edge_below_noise = false;
  /// Whether the fit has another axis as z, or the section rotated by 45 degrees. For nearly equal exponents noise may favour such
  /// a body. Its parameters then cannot be compared with the truth.
  bool has_other_axes = false;
};

Compared compare(const FittedBody& fitted, const Body& truth);

/// Fits data of the truth within its own family.
Compared fit_and_compare(const Body& truth, const Scatter& scatter);

}  // namespace fit
