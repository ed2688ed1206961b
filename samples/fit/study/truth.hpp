// Bodies that are known, data of them, and what a fit has made of these.
#pragma once

#include <cstdint>

#include "model/body.hpp"
#include "model/cloud.hpp"

namespace fit {

struct Scatter {
  std::size_t points = 2000;
  double noise = 0;              ///< standard deviation in every direction, over the mean half-axis (a b c)^(1/3)
  bool is_half_missing = false;  ///< only points on one side of an oblique plane through the centre
  bool has_normals = false;
  std::uint64_t seed = 1;
};

/// Data of a body: evenly spread points, in its place. Those of the missing half are in none of the `points`.
Cloud scatter(const Body& truth, const Scatter& settings);

double mean_half_axis(const Body& body);

/// `fitted` in that of its equivalent frames which is nearest to the frame of `truth`: axes may point the other way (a
/// taper then changes its sign), x and y change places, and where both exponents of the truth are the same, which axis is called z
/// is chance.
Body aligned(const Body& fitted, const Body& truth, Eigen::Matrix3d& axes);

/// The numbers of `fitted` less those of `truth`, in the order of kPosition to kTaper; exponents and half-axes as such.
Eigen::Matrix<double, kParameters, 1> deviation(const Body& fitted, const Body& truth);

}  // namespace fit
