// Distributions of the sizes of grains.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace falling_particles {

/// A distribution of positive sizes between two bounds, represented by its quantiles. Sizes are in m, or relative to a unit.
class SizeDistribution {
 public:
  /// Whether fractions of the distribution are by number of grains or by mass. Mass is proportional to the third power of the size.
  enum class By { Number, Mass };

  struct Bounds {
    double smallest, largest;  ///< 0 < smallest < largest
  };

  /// A constant density between the bounds.
  static SizeDistribution uniform(Bounds bounds, By by);
  /// A normal distribution with mean `mean` and standard deviation `deviation` > 0, truncated to the bounds.
  static SizeDistribution normal(double mean, double deviation, Bounds bounds, By by);
  /// A lognormal distribution, truncated to the bounds. Before truncation, half of it is below `median`. `geometric_deviation` > 1
  /// is the factor of one standard deviation of the logarithm.
  static SizeDistribution lognormal(double median, double geometric_deviation, Bounds bounds, By by);
  /// `passing` is the fraction that is smaller than each of the increasing `openings`. It must increase from 0 to 1; equal
  /// neighbours are allowed. Linear between openings.
  static SizeDistribution sieve(const std::vector<double>& openings, const std::vector<double>& passing, By by);

  /// The size below which the fraction p in [0, 1] of the number of grains lies, whatever `by` was. Exact for densities that are
  /// linear between the nodes. The error of others is at most a millionth of the distance of the bounds.
  double quantile(double p) const;

  double smallest() const { return nodes_.front(); }
  double largest() const { return nodes_.back(); }

 private:
  /// `density`: of the given distribution, up to a factor, between two neighbours of `ends`.
  SizeDistribution(const std::vector<double>& ends, By by, const std::function<double(std::size_t piece, double size)>& density);

  std::vector<double> nodes_;                              // increasing
  std::vector<double> density_at_start_, density_at_end_;  // by number, in each cell between two nodes, up to a factor
  std::vector<double> cumulative_;                         // fraction of the number below each node
};

/// `count` sizes in random order that follow the distribution as closely as that number can. Each one is the quantile of a random
/// fraction within its own interval of length 1 / count. The same seed gives the same sizes everywhere.
std::vector<double> draw_sizes(const SizeDistribution& distribution, int count, std::uint64_t seed);

/// The seed for the sizes of a kind of grain. So the sizes of a kind do not depend on the other kinds, and nothing else depends on
/// them.
std::uint64_t seed_of_sizes(std::uint64_t scene_seed, std::size_t kind);

}  // namespace falling_particles
