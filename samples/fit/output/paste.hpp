// Lines to paste into the files of other programs.
#pragma once

#include <span>
#include <string>

#include "model/fit_body.hpp"
#include "model/fit_error.hpp"

namespace fit {

/// A catalogue of grains for samples/falling_particles with one grain. A union has its bodies as `parts` about their middle.
std::string toml_lines(std::span<const FittedBody> bodies, const std::string& name, double density, const std::string& source);

/// C code that creates the geoms of the bodies in their poses in the frame of the data, `dGeomID geom_name_1 = snCreate…(space,
/// …);`, and their mass about its own centre, `mass_name`. `solid`: the union of the bodies, for density 1.
std::string c_lines(std::span<const FittedBody> bodies, const std::string& name, const std::string& source, const Solid& solid,
                    double density);

/// The number of digits of a coordinate that leaves `digits` digits relative to the size of the body, which may be far from the
/// origin. At most 17, as for a double.
int digits_of(double coordinate, double size, int digits);

/// `text` with every character (of UTF-8) that is invalid in a name of the catalogue replaced by _.
std::string identifier(const std::string& text);

}  // namespace fit
