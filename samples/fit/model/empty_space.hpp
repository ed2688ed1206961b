// The empty space around the data.
#pragma once

#include <vector>

#include "body.hpp"
#include "cloud.hpp"

namespace fit {

/// Points of a surface, with outward normals and the area around each.
struct Surface {
  std::vector<Vector3> points, normals;
  std::vector<double> areas;
  double noise = 0;  ///< the median distance of neighbours from the tangent plane
};

/// The surface of at most 2000 of the points. Points without normals get the normals of the planes through their neighbours. They
/// point to the side from which more directions lead out of the data (Takayama et al. 2014).
Surface make_surface(const Cloud& cloud);

/// 1 inside the surface, 0 outside, in between if the surface is open (Jacobson, Kavan and Sorkine-Hornung 2013; for points Barill
/// et al. 2018).
double winding_number(const Surface& surface, const Vector3& x);

/// Balls outside the data: a body that enters one extends beyond the data. The depth to which it enters is a lower bound of the
/// distance of its surface from the data.
struct EmptySpace {
  std::vector<Vector3> centres;
  std::vector<double> radii;
};

/// The empty space around points of a surface, of extent 1. Two kinds of balls:
/// - very large ones in 200 directions, which are half-spaces: a body may not extend beyond the convex hull;
/// - balls that touch the surface from outside, which fill its concavities.
/// The radii are smaller than the distance from the data by twice the noise and twice the mean spacing of the points.
///
/// A point is outside if its winding number is below 1/2.
EmptySpace find_empty_space(const Cloud& data);

/// Each `step`-th ball.
EmptySpace thinned(const EmptySpace& space, std::size_t step);

/// The image under x -> scale x + offset.
EmptySpace moved(const EmptySpace& space, double scale, const Vector3& offset);

/// The penalty of a body that enters the balls: the mean square of its depths in them, times a weight. It adds to the mean square
/// of the distances of the data from the body.
double penalty_of(const Body& body, const EmptySpace& space);

/// The weight of penalty_of(), without unit: a depth counts as much as a distance sqrt(20) times as large. See README.md for
/// others.
constexpr double kEmptyWeight = 20;

}  // namespace fit
