// What the fit found, in words and numbers.
#pragma once

#include <span>
#include <string>

#include "model/fit_body.hpp"
#include "model/fit_error.hpp"

namespace fit {

/// The numbers of a body, each with one standard error, or why it has none.
std::string describe(const FittedBody& fitted);

/// The points of the cloud that the fits left out: how many, and the farthest of them by number (from 1), place and distance from
/// the bodies. "" where there are none.
std::string describe_outliers(std::span<const FittedBody> fitted, const Cloud& cloud);

/// Distances, volume and inertia beside those of the data.
std::string describe(const FitError& error);

}  // namespace fit
