// Points on a surface.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace fit {

struct Cloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< unit, outward, one for each point; or empty
};

/// Position and size of the data. The fit works on (x - centre) / size.
struct Extent {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< the mean
  double size = 1;                                   ///< root mean square distance from the centre
};

/// Uniform in [0, 1), the same with every standard library.
double uniform(std::mt19937_64& random);

/// The value that `rank` others precede in ascending order, and the one in the middle.
double ranked(std::vector<double> values, std::size_t rank);
double median(std::vector<double> values);

Extent extent_of(std::span<const Eigen::Vector3d> points);

/// The radius about the centroid that contains 99 % of the points.
double radius_of(std::span<const Eigen::Vector3d> points);

/// The points that do not belong to one surface with the others, as ascending indices. Distances are from the median of each
/// coordinate. A surface leaves no empty shell whose outer radius is twice its inner one. Points beyond the first such shell are
/// cut off. If there are more than `most`, they are part of the data and none is cut off. None, too, if a coordinate is not finite.
std::vector<std::size_t> cut_off(std::span<const Eigen::Vector3d> points, std::size_t most);

/// The points far from all others, as ascending indices: their mean distance from eight neighbours is more than three times the
/// median of these distances. None if they are more than a quarter of the points, or if a coordinate is not finite: then the
/// density varies.
std::vector<std::size_t> isolated(std::span<const Eigen::Vector3d> points);

/// The cloud translated and scaled to extent 1 about the origin.
Cloud normalized(const Cloud& cloud, const Extent& extent);

/// A random choice of `count` points, or all if there are fewer. The choice is always the same, so that results depend on the data
/// only.
Cloud thinned(const Cloud& cloud, std::size_t count);

/// Uniformly spread unit vectors, always the same (Gonzalez, Mathematical Geosciences 42, 2010).
std::vector<Eigen::Vector3d> spread_directions(int count);

/// The points with these indices, and all others.
Cloud selected(const Cloud& cloud, std::span<const std::size_t> indices);
Cloud without(const Cloud& cloud, std::span<const std::size_t> indices);

/// The indices below `count` that are none of these.
std::vector<std::size_t> others_than(std::span<const std::size_t> indices, std::size_t count);

/// The cluster index of each point: Lloyd's k-means with k-means++ starts (Arthur and Vassilvitskii 2007).
std::vector<int> find_clusters(std::span<const Eigen::Vector3d> points, int count, std::uint64_t seed);

}  // namespace fit
