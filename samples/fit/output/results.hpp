// What a fit writes for other programs: lines to paste into their files, JSON, and the data in the frame of the grain.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "input/triangles.hpp"
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
