// Lines to paste into the files of other programs.
#pragma once

#include <span>
#include <string>

#include "model/fit_body.hpp"

namespace fit {

/// A catalogue of grains for samples/falling_particles with one grain. A union has its bodies as `parts` about their middle.
std::string toml_lines(std::span<const FittedBody> bodies, const std::string& name, double density, const std::string& source);

/// C code that creates the geoms of the bodies in their poses: `dGeomID name_1 = snCreate…(space, …);`.
std::string c_lines(std::span<const FittedBody> bodies, const std::string& name, const std::string& source);

/// The number of digits of a coordinate that leaves `digits` digits relative to the size of the body, which may be far from the
/// origin. At most 17, as for a double.
int digits_of(double coordinate, double size, int digits);

/// `text` with every character that is invalid in a name of C or of the catalogue replaced by _.
std::string identifier(const std::string& text);

}  // namespace fit
