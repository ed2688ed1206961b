// Points on the surface of a thing.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace fit {

struct Cloud {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< unit, outward, one for each point; or none
};

/// Where data lie and how large they are: the fit works on (x - centre) / size.
struct Extent {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< the mean
  double size = 1;                                   ///< root mean square distance from the centre
};

Extent extent_of(std::span<const Eigen::Vector3d> points);

/// The distance from the centroid that 99 % of the points do not exceed.
double radius_of(std::span<const Eigen::Vector3d> points);

/// The points that are no part of one surface with the others: ascending indices. From the middle of the points
/// (the median of each coordinate) outwards, a surface leaves no empty shell that is as thick as what it encloses: points beyond
/// the first such shell are cut off, unless they are more than `most`, and then a part of the data. None where a coordinate is not
/// finite.
std::vector<std::size_t> cut_off(std::span<const Eigen::Vector3d> points, std::size_t most);

/// The cloud with its extent moved to the origin and to 1.
Cloud normalized(const Cloud& cloud, const Extent& extent);

/// `count` of the points, or all if there are fewer, chosen by lot: always the same ones, so that the answer depends on the data
/// alone.
Cloud thinned(const Cloud& cloud, std::size_t count);

/// The cloud of the points with these indices.
Cloud selected(const Cloud& cloud, std::span<const std::size_t> indices);

}  // namespace fit
