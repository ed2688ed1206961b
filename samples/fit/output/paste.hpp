// Lines to paste into other programs' files.
#pragma once

#include <span>
#include <string>

#include "model/fit_body.hpp"

namespace fit {

/// A catalogue of grains for samples/falling_particles: one grain, a union with its `parts` about their middle.
std::string toml_lines(std::span<const FittedBody> bodies, const std::string& name, double density, const std::string& source);

/// C that creates the bodies' geoms in their places: `dGeomID name_1 = snCreate…(space, …);`.
std::string c_lines(std::span<const FittedBody> bodies, const std::string& name, const std::string& source);

/// How many digits a coordinate takes so that `digits` of them are left of a body of this size, which may be far from the origin:
/// at most the 17 of a double.
int digits_of(double coordinate, double size, int digits);

/// `text` with whatever neither C nor the catalogue takes in a name replaced by _.
std::string identifier(const std::string& text);

}  // namespace fit
