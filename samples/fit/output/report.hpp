// The result of a fit as text.
#pragma once

#include <span>
#include <string>

#include "model/fit_body.hpp"
#include "model/fit_error.hpp"

namespace fit {

/// The parameters of a body, each with one standard error, or the reason why it has none.
std::string describe(const FittedBody& fitted);

/// The points that the fits ignored: how many, and the farthest ones with index (from 1), position and distance from the bodies. ""
/// if there are none.
std::string describe_outliers(std::span<const FittedBody> fitted, const Cloud& cloud);

/// Distances, volume and inertia of the bodies, next to the values of the data.
std::string describe(const FitError& error);

}  // namespace fit
