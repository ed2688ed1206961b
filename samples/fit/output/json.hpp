// The result of a fit for other programs.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "input/orientation.hpp"
#include "model/fit_body.hpp"
#include "model/fit_error.hpp"

namespace fit {

/// Where the numbers come from.
struct Provenance {
  std::string name, source;
  double scale = 1;       ///< metres in a unit of the file
  double density = 1000;  ///< kg/m^3
  bool is_mesh = false;
  OpenEdges open = {};  ///< of a mesh
};

/// JSON with the bodies, each number with its standard error, the errors of the fit, and the warnings. It contains its units and
/// frames. A standard error is null if the data do not determine the number, and 0 if the number is fixed.
std::string json_text(std::span<const FittedBody> fitted, const FitError& error, const std::vector<std::string>& warnings,
                      const Provenance& provenance);

/// The origin of the grain in the frame of the data: the body's centre, or the mean centre of the bodies of a union.
Vector3 grain_origin(std::span<const FittedBody> fitted);

/// The data in the frame of the grain, as a .ply: a body's axes are those of the frame. A union keeps the axes of the data.
std::string aligned_ply(const Data& data, std::span<const FittedBody> fitted);

}  // namespace fit
