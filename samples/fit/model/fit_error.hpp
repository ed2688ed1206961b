// Measures of the error of a body, or of a union of bodies.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "body.hpp"
#include "distance.hpp"
#include "fit_body.hpp"
#include "input/read_data.hpp"

namespace fit {

/// Volume integrals for density 1, in the frame of the data.
struct Solid {
  double volume = 0;
  Vector3 centroid = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();  ///< about the centroid
};

struct FitError {
  double rms = 0;                           ///< distances of the data points from the surface of the body
  double to_body = 0;                       ///< largest distance of a data point from the surface of the body
  double mean = 0;                          ///< mean signed distance of the data from the surface; positive: the data are outside
  double to_data = 0;                       ///< largest distance of a point of the body's surface from the data
  double reach = 0;                         ///< how far the body extends beyond the data and the surface that closes their holes
  double radius = 0;                        ///< of the data, about their centre
  double openness = 0;                      ///< of the surface of the data (Surface::openness)
  Solid body;                               ///< union of the bodies: overlaps count once
  double body_error = 0;                    ///< standard error of a Monte Carlo volume; 0: closed form
  double volume_error = 0;                  ///< standard error of the volume of `body`, see add_uncertainty()
  Vector3 moment_errors = Vector3::Zero();  ///< and of its principal moments of inertia, in ascending order
  Solid data;                               ///< mesh if closed, else convex hull
  bool is_hull = false;                     ///< whether `data` is the convex hull
};

/// The largest root mean square of the distances and the largest reach of a good fit, over the radius of the data.
constexpr double kMostDistance = 0.05, kMostReach = 0.05;

/// Whether the data are a closed mesh: every edge is traversed equally often in both directions. Degenerate triangles are ignored
/// unless they are needed.
bool is_closed(const Data& data);

/// Volume and area of a closed mesh.
VolumeTarget volume_target(const Data& data);

/// Points of the union's surface: `count` samples on each body, always the same, without those inside another body.
std::vector<Vector3> free_surface(std::span<const DistanceFunction> functions, std::size_t count);

struct VolumeIntegral {
  Solid solid;
  double volume_error = 0;  ///< standard error of the volume
};

/// Volume integrals of a union by Monte Carlo, always with the same points.
VolumeIntegral integrate_union(std::span<const Body> bodies);

/// Adds standard errors of volume and moments of inertia. Each is the root of a sum of squares: the error that follows from the
/// covariance of the parameters, the error of Monte Carlo, and the misfit. The misfit is the difference from a closed mesh. For
/// other data it is the mean signed distance of the data from the surface, times the area of the surface, and the openness of the
/// data times the volume if no body of the families fits: so much of a sphere would be hidden.
///
/// If a parameter moves the surface by dh along its normal, an integral of f over the body changes by the integral of f dh over the
/// surface (Reynolds' transport theorem).
void add_uncertainty(FitError& error, std::span<const FittedBody> fitted);

/// Hausdorff distances over the data vertices (for a mesh also random points of its triangles) and over random points of the free
/// surface of the bodies. They are lower bounds: the true distances are larger by at most the spacing of the points.
FitError find_error(std::span<const Body> bodies, const Data& data);

/// Only the distances of find_error(), without the solids. The reach beyond a cloud is measured from discs around its points, in
/// their tangent planes, with a radius of kSpacings spacings.
FitError find_distances(std::span<const Body> bodies, const Data& data);

}  // namespace fit
