// The result of a fit for other programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/fit_body.hpp"
#include "model/fit_error.hpp"

namespace fit {

/// JSON with the bodies, each number with its standard error, the errors of the fit, and the warnings. Lengths are in metres,
/// rotations in rad, volumes in m^3, moments of inertia in m^5 (for density 1). A standard error is null if the data do not
/// determine the number, and 0 if the number is fixed.
std::string json_text(std::span<const FittedBody> fitted, const FitError& error, const std::vector<std::string>& warnings,
                      const std::string& name, const std::string& source);

/// The origin of the grain in the frame of the data: the body's centre, or the mean centre of the bodies of a union.
Vector3 grain_origin(std::span<const FittedBody> fitted);

/// The data in the frame of the grain, as a .ply: a body's axes are those of the frame. A union keeps the axes of the data.
std::string aligned_ply(const Data& data, std::span<const FittedBody> fitted);

}  // namespace fit
