// Distributions of the sizes of grains.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace falling_particles {

/// A distribution of positive sizes between two bounds, known by its quantiles. Sizes are in m, or relative to something.
class SizeDistribution {
 public:
  /// What a share of the distribution is: of the number of grains, or of their mass, which goes with the third power of the size.
  enum class By { Number, Mass };

  struct Bounds {
    double smallest, largest;  ///< 0 < smallest < largest
  };

  /// The same density from end to end.
  static SizeDistribution uniform(Bounds bounds, By by);
  /// A normal distribution of mean and standard deviation `mean` and `deviation`, > 0, of which only what is within the bounds
  /// counts.
  static SizeDistribution normal(double mean, double deviation, Bounds bounds, By by);
  /// The logarithm is normal, of which only what is within the bounds counts: half of the whole is below `median`;
  /// `geometric_deviation`, > 1, is the factor that a standard deviation of the logarithm amounts to.
  static SizeDistribution lognormal(double median, double geometric_deviation, Bounds bounds, By by);
  /// `passing`, from 0 to 1, never falling: the share that is smaller than each of `openings`, which rise. Linear between them.
  static SizeDistribution sieve(const std::vector<double>& openings, const std::vector<double>& passing, By by);

  /// The size that the share p, in [0, 1], of the number of grains is below, whatever the distribution was given by. Exact for
  /// densities that are linear between its nodes; a millionth or less of the bounds' distance for the others.
  double quantile(double p) const;

  double smallest() const { return nodes_.front(); }
  double largest() const { return nodes_.back(); }

 private:
  /// `density`: of the distribution that was given, to any scale, between two neighbours of `ends`.
  SizeDistribution(const std::vector<double>& ends, By by, const std::function<double(std::size_t piece, double size)>& density);

  std::vector<double> nodes_;                              // rising
  std::vector<double> density_at_start_, density_at_end_;  // by number, of each cell between two nodes, to any scale
  std::vector<double> cumulative_;                         // share of the number below each node
};

/// As many sizes as grains, in random order, that follow the distribution as closely as that number can: each is the quantile of a
/// random share within its own equal part of the whole. The same seed gives the same sizes everywhere.
std::vector<double> draw_sizes(const SizeDistribution& distribution, int count, std::uint64_t seed);

/// The seed for the sizes of a scene's kind of grain: those of one kind do not depend on the other kinds, nor anything else on
/// them.
std::uint64_t seed_of_sizes(std::uint64_t scene_seed, std::size_t kind);

}  // namespace falling_particles
