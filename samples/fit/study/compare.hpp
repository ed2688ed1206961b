// A fit beside the body that its data are of.
#pragma once

#include <array>

#include "model/fit_body.hpp"
#include "truth.hpp"

namespace fit {

/// A fit in the frame of the truth, with its standard errors there.
struct Compared {
  Body body;
  Gradient deviation = Gradient::Zero();       ///< of `body` from the truth, as fit::deviation
  Gradient standard_error = Gradient::Zero();  ///< as Uncertainty::standard_error
  std::array<bool, kParameters> is_determined{};
  bool is_edge_below_noise = false;
  /// Whether another axis of the body is called z, or the section is turned by half a right angle: with exponents that are nearly
  /// the same, noise may make such a body fit a little better, and its numbers are then not those of the truth.
  bool has_other_axes = false;
};

Compared compare(const FittedBody& fitted, const Body& truth);

/// Fits the data of the truth, in its own family.
Compared fit_and_compare(const Body& truth, const Scatter& scatter);

}  // namespace fit
