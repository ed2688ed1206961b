// A scan: its file, its points, and the fit of bodies to them.
#pragma once

#include <string>
#include <vector>

#include "input/read_data.hpp"
#include "input/triangles.hpp"
#include "model/fit_error.hpp"
#include "model/fit_union.hpp"
#include "options.hpp"

namespace fit {

struct Scan {
  std::string path;
  Data data;
  Cloud points;                      ///< to fit; for a mesh: random points of its triangles
  bool is_closed = false;            ///< whether the data are a closed mesh
  OpenEdges open = {};               ///< of an open mesh
  std::vector<std::string> remarks;  ///< for the user: what was read, left out and turned round
};

/// Reads a scan. Throws InputError.
Scan read_scan(const std::string& path, const Options& options);

FitSettings settings_of(const Options& options, const Scan& scan);

/// Fits at most `options.bodies` bodies. Announces its steps. Throws InputError.
std::vector<FittedBody> fit_scan(const Scan& scan, const Options& options);

/// Compares the bodies with the data, without the outliers of the fit.
FitError find_error(const Scan& scan, const std::vector<FittedBody>& fitted);

/// What the fitted points say of the error at once: the root mean square and the largest of their distances, and their radius.
/// Reach and volume are not examined.
FitError find_distances(const Scan& scan, const std::vector<FittedBody>& fitted);

/// Announces the next step at once, also into a pipe.
void say(const std::string& step);

}  // namespace fit
