// A kind of grains from several scans.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "model/fit_error.hpp"

namespace fit {

/// One scan of a kind and its fit.
struct Specimen {
  std::string name;
  std::vector<FittedBody> fitted;
  Solid solid;  ///< density 1
};

/// The shape of a solid by the ellipsoid with its moments of inertia per volume (Zingg 1935, for the axes).
struct Proportions {
  double elongation = 1;  ///< the middle half-axis over the longest
  double flatness = 1;    ///< the shortest over the middle
  double fullness = 1;    ///< the volume over the ellipsoid's: 1 of an ellipsoid, 0.89 of a box, less of a branched body
};

Proportions proportions_of(const Solid& solid);

/// The index of the specimen that stands for the kind: its elongation and flatness are nearest to their geometric means.
std::size_t typical_of(std::span<const Specimen> specimens);

/// The lines of a scene: a kind of this name with the sizes of the specimens as a lognormal distribution. The length is the sieve
/// size of the typical specimen, scaled to the volume of each. Without `size` if all have the same volume, to rounding.
std::string scene_lines(std::span<const Specimen> specimens, const std::string& name);

/// A line for each specimen, and the mean and the standard deviation of their proportions.
std::string describe(std::span<const Specimen> specimens);

}  // namespace fit
