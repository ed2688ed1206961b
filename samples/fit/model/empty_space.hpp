// The empty space around the data.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "body.hpp"
#include "cloud.hpp"

namespace fit {

/// Points of a surface, with outward normals and the area around each.
struct Surface {
  std::vector<Vector3> points, normals;
  std::vector<double> areas;
  /// The length of the vector area over the area: 0 of a closed surface, 1/2 of half a sphere, 1 of a plane.
  double openness = 0;
};

/// The surface of at most 2000 of the points. Points without normals get the normals of the planes through their neighbours. They
/// point to the side from which more directions lead out of the data (Takayama et al. 2014).
Surface make_surface(const Cloud& cloud);

/// The surface of a cloud extends from each point by this many of their spacings. Vertices and edges of a body lie there, between
/// the points.
constexpr double kSpacings = 2;

/// 1 inside the surface, 0 outside, in between if the surface is open (Jacobson, Kavan and Sorkine-Hornung 2013; for points Barill
/// et al. 2018).
double winding_number(const Surface& surface, const Vector3& x);

/// Whether a place is outside the data: its winding number is below (1 - openness) / 2. What a one-sided scan hides is not outside.
bool is_outside(const Surface& surface, const Vector3& x);

/// Points of the surface that closes the holes of data of extent 1: where the winding number crosses the threshold of is_outside(),
/// except near the data. None if there are no holes.
std::vector<Vector3> closing_points(const Cloud& data);

/// The weight of penalty_of(), without unit: an excess counts as much as a distance sqrt(20) times as large. See constants.md for
/// others.
constexpr double kEmptyWeight = 20;

struct DistanceGrid;

/// How far a place lies beyond the data and the surface that closes their holes: 0 inside and up to a margin outside. Without a
/// grid it is 0 everywhere.
struct EmptySpace {
  std::shared_ptr<const DistanceGrid> grid;
  double scale = 1;  ///< x is at scale x + offset in the grid
  Vector3 offset = Vector3::Zero();
  double margin = 0;  ///< in extents of the data, as is `steep`
  /// Beyond this excess, the penalty grows as its fourth power.
  double steep = std::numeric_limits<double>::infinity();
  double weight = kEmptyWeight;  ///< of penalty_of()
  bool is_fine = false;          ///< selects the boundary_directions()

  struct Excess {
    double length = 0;                ///< e (1 + e/s) with s = steep and e, the distance from the data less the margin
    Vector3 slope = Vector3::Zero();  ///< its derivative by the place
  };
  Excess beyond(const Vector3& x) const;
};

/// The empty space around points of a surface, of extent 1. The margin is twice the noise and twice the mean spacing of the points.
EmptySpace find_empty_space(const Cloud& data);

/// The image under x -> scale x + offset.
EmptySpace moved(const EmptySpace& space, double scale, const Vector3& offset);

/// The penalty of a body that extends beyond the data: the mean square of the excess of its boundary_directions(), times the
/// weight. It adds to the mean square of the distances of the data from the body.
double penalty_of(const Body& body, const EmptySpace& space);

/// The directions in which a body is examined: its faces, edges and vertices, and 600 directions between them, or 20000 if
/// `is_fine`.
const std::vector<Vector3>& boundary_directions(bool is_fine);

}  // namespace fit
