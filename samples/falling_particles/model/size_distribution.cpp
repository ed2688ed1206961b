#include "size_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/random.hpp"

namespace falling_particles {

using namespace common;
namespace {

constexpr std::size_t kCellsPerPiece = 2000;

/// `ends` and `cells_per_piece` - 1 points between each two of them, in equal ratios.
std::vector<double> refine(const std::vector<double>& ends, std::size_t cells_per_piece) {
  std::vector<double> nodes;
  nodes.reserve((ends.size() - 1) * cells_per_piece + 1);
  for (std::size_t piece = 0; piece + 1 < ends.size(); ++piece) {
    const double ratio = ends[piece + 1] / ends[piece];
    for (std::size_t i = 0; i < cells_per_piece; ++i) {
      nodes.push_back(ends[piece] * std::pow(ratio, static_cast<double>(i) / static_cast<double>(cells_per_piece)));
    }
  }
  nodes.push_back(ends.back());
  return nodes;
}

/// The relative position in a cell below which the fraction p of the cell lies. The density is linear from f0 to f1.
double share_of_way(double f0, double f1, double p) {
  // solved without cancellation
  const double root = std::sqrt(f0 * f0 + p * (f1 - f0) * (f1 + f0));
  return f0 + root > 0 ? p * (f0 + f1) / (f0 + root) : 0;
}

}  // namespace

SizeDistribution::SizeDistribution(const std::vector<double>& ends, By by,
                                   const std::function<double(std::size_t piece, double size)>& density)
    : nodes_(refine(ends, std::max<std::size_t>(1, kCellsPerPiece / (ends.size() - 1)))) {
  const std::size_t cells = nodes_.size() - 1;
  const std::size_t cells_per_piece = cells / (ends.size() - 1);
  // The larger the grains are, the fewer of them are in a given mass.
  const auto by_number = [&](std::size_t piece, double size) {
    return density(piece, size) / (by == By::Mass ? std::pow(size / nodes_.back(), 3) : 1);
  };
  density_at_start_.reserve(cells);
  density_at_end_.reserve(cells);
  cumulative_.reserve(cells + 1);
  cumulative_.push_back(0);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    density_at_start_.push_back(by_number(cell / cells_per_piece, nodes_[cell]));
    density_at_end_.push_back(by_number(cell / cells_per_piece, nodes_[cell + 1]));
    const double mean = (density_at_start_.back() + density_at_end_.back()) / 2;
    cumulative_.push_back(cumulative_.back() + mean * (nodes_[cell + 1] - nodes_[cell]));
  }
  for (double& share : cumulative_) share /= cumulative_.back();
}

SizeDistribution SizeDistribution::uniform(Bounds bounds, By by) {
  return {{bounds.smallest, bounds.largest}, by, [](std::size_t, double) { return 1.0; }};
}

SizeDistribution SizeDistribution::normal(double mean, double deviation, Bounds bounds, By by) {
  // Scaled to be 1 where it is largest within the bounds, so that a far tail does not vanish.
  const double nearest = std::clamp(mean, bounds.smallest, bounds.largest);
  const auto exponent = [=](double size) { return -std::pow((size - mean) / deviation, 2) / 2; };
  return {{bounds.smallest, bounds.largest}, by, [=](std::size_t, double size) {
            return std::exp(exponent(size) - exponent(nearest));
          }};
}

SizeDistribution SizeDistribution::lognormal(double median, double geometric_deviation, Bounds bounds, By by) {
  const double nearest = std::clamp(median, bounds.smallest, bounds.largest);
  const auto exponent = [=](double size) { return -std::pow(std::log(size / median) / std::log(geometric_deviation), 2) / 2; };
  return {{bounds.smallest, bounds.largest}, by, [=](std::size_t, double size) {
            return std::exp(exponent(size) - exponent(nearest)) * nearest / size;
          }};
}

SizeDistribution SizeDistribution::sieve(const std::vector<double>& openings, const std::vector<double>& passing, By by) {
  return {openings, by, [&](std::size_t piece, double) {
            return (passing[piece + 1] - passing[piece]) / (openings[piece + 1] - openings[piece]);
          }};
}

double SizeDistribution::quantile(double p) const {
  const auto above = std::upper_bound(cumulative_.begin(), cumulative_.end(), p);
  if (above == cumulative_.begin()) return smallest();
  if (above == cumulative_.end()) return largest();
  const auto cell = static_cast<std::size_t>(above - cumulative_.begin()) - 1;
  const double within = (p - cumulative_[cell]) / (cumulative_[cell + 1] - cumulative_[cell]);
  return std::lerp(nodes_[cell], nodes_[cell + 1], share_of_way(density_at_start_[cell], density_at_end_[cell], within));
}

std::vector<double> draw_sizes(const SizeDistribution& distribution, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) sizes.push_back(distribution.quantile((i + random.uniform()) / count));
  for (std::size_t i = sizes.size(); i > 1; --i) std::swap(sizes[i - 1], sizes[random.below(i)]);  // Fisher-Yates
  return sizes;
}

std::uint64_t seed_of_sizes(std::uint64_t scene_seed, std::size_t kind) {
  // A step of SplitMix64: Steele, Lea, Flood, Fast splittable pseudorandom number generators, OOPSLA 2014.
  std::uint64_t z = scene_seed + (kind + 1) * 0x9e3779b97f4a7c15U;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}

}  // namespace falling_particles
