// One kind of grain from the bodies of many scans.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/fit_body.hpp"

namespace fit {

/// The fits of one scan with its shortest, middle and longest axis as z. An ellipsoid and a body of revolution have one such fit
/// only: all three are equal.
using FitsByAxis = std::array<FittedBody, 3>;

/// Fits of `family`, which contains the family of `fitted`, near `fitted`. Where another axis becomes z, the exponents start at
/// their mean, and the taper at 0. Throws like fit_body().
FitsByAxis fit_each_axis(const FittedBody& fitted, Family family, const Cloud& points, const FitSettings& settings);

/// Which of the three axes is z in all scans: the one that leaves the smallest sum of squared distances, relative to the sizes of
/// the bodies. The exponents of different scans are then comparable.
std::size_t common_axis(std::span<const FitsByAxis> scans);

/// A number over the scans.
struct Spread {
  double mean = 0;
  double deviation = 0;  ///< standard deviation between scans, with the errors of the fits
  double error = 0;      ///< root mean square of the standard errors of the fits; undetermined numbers do not count
};

/// A kind of grain: one shape, and a lognormal distribution of sizes. The size of a scan is the cube root of its body's volume.
struct GrainKind {
  Body body;  ///< the means of ratios, exponents and taper; its size is the median
  Spread b_over_a, c_over_a, delta, epsilon, taper;
  std::vector<double> sizes;  ///< m, of the scans
  double median = 0;          ///< m, the geometric mean of the sizes
  double geometric_deviation = 1;
};

/// The size of a body, m.
double size_of(const Body& body);

/// The kind of at least two bodies of one family. Throws std::invalid_argument if there are fewer.
GrainKind find_kind(std::span<const FittedBody> scans);

}  // namespace fit
