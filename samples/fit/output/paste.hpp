// Lines to paste into other programs' files.
#pragma once

#include <span>
#include <string>

#include "model/fit_body.hpp"

namespace fit {

/// A catalogue of grains for samples/falling_particles: a table for each body, `name` or `name_1`, `name_2`... The catalogue has no
/// superovoids; these are left out with a comment that says so.
std::string toml_lines(std::span<const FittedBody> bodies, const std::string& name, double density, const std::string& source);

/// C that creates the bodies' geoms in their places: `dGeomID name_1 = snCreate…(space, …);`.
std::string c_lines(std::span<const FittedBody> bodies, const std::string& name, const std::string& source);

/// `text` with whatever neither C nor the catalogue takes in a name replaced by _.
std::string identifier(const std::string& text);

}  // namespace fit
