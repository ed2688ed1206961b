// Known bodies (random ones, compounds and stones), data sampled from them, and fits to these data.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "model/body.hpp"
#include "model/cloud.hpp"
#include "model/fit_body.hpp"

namespace fit {

/// A superellipsoid in a random orientation, with distinct half-axes (0.4 to 1.6, in any order). The exponents are in [1.3, 8],
/// uniform in ln(exponent - 1).
Body random_superellipsoid(std::mt19937_64& random);

/// The same with a taper of at most `share` of the limit of a convex body, of either sign.
Body random_superovoid(std::mt19937_64& random, double share);

/// "dumbbell": two discs and a bar. "molar": a crown on two roots, all superovoids. Throws std::invalid_argument for other names.
std::vector<Body> make_compound(const std::string& name);

/// Superellipsoids in random poses. The size, the cube root of the volume, is lognormal with the median 10 mm and the geometric
/// deviation 1.25. The ratios b/a and c/a are normal, 0.8 ± 0.05 and 0.6 ± 0.04. The logarithms of the exponents less 1 are normal,
/// with the medians 2.4 and 2.8 of the exponents delta and epsilon, and the deviation 0.1.
std::vector<Body> make_stones(std::size_t count, std::uint64_t seed);

struct Scatter {
  std::size_t points = 2000;
  double noise = 0;              ///< standard deviation in each direction, relative to the mean half-axis (a b c)^(1/3)
  bool is_half_missing = false;  ///< only points on one side of an oblique plane through the centre
  bool has_normals = false;
  std::uint64_t seed = 1;
};

/// Data of a body in its pose: uniformly spread points. `points` counts only the half that is kept.
Cloud scatter(const Body& truth, const Scatter& settings);

/// `count` random points on each body, without those inside another, with isotropic noise of standard deviation `sigma` (m).
Cloud scatter_union(const std::vector<Body>& bodies, std::size_t count, double sigma, std::uint64_t seed);

/// Normal random numbers, the same with every standard library (Box and Muller).
class NormalNumbers {
 public:
  explicit NormalNumbers(std::uint64_t seed) : random_(seed) {}
  double operator()();

 private:
  std::mt19937_64 random_;
};

double mean_half_axis(const Body& body);

/// `fitted` in its equivalent frame nearest to the frame of `truth`. Axes may be reversed (a taper then changes its sign), and x
/// and y may be swapped. If both exponents of the truth are equal, the choice of z is arbitrary.
Body aligned(const Body& fitted, const Body& truth, Eigen::Matrix3d& axes);

/// The parameters of `fitted` minus those in `truth`, in the order of kPosition to kTaper; exponents and half-axes as such.
Eigen::Matrix<double, kParameters, 1> deviation(const Body& fitted, const Body& truth);

/// A fit in the frame of the truth, with its standard errors in that frame.
struct Compared {
  Body body;
  Gradient deviation = Gradient::Zero();       ///< of `body` from the truth, as in fit::deviation
  Gradient standard_error = Gradient::Zero();  ///< as in Uncertainty::standard_error
  std::array<bool, kParameters> is_determined{};
  bool is_edge_below_noise = false;
  /// Whether the fit has another axis as z, or the section rotated by 45 degrees. For nearly equal exponents noise may favour such
  /// a body. Its parameters then cannot be compared with the truth.
  bool has_other_axes = false;
};

Compared compare(const FittedBody& fitted, const Body& truth);

/// Fits data of the truth within its own family.
Compared fit_and_compare(const Body& truth, const Scatter& scatter);

}  // namespace fit
