// How far a body, or a union of some, is from the data that it stands for.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "body.hpp"
#include "distance.hpp"
#include "input/read_data.hpp"

namespace fit {

/// Volume integrals of density 1, about the centroid, in the frame of the data.
struct Solid {
  double volume = 0;
  Vector3 centroid = Vector3::Zero();
  Matrix3 inertia = Matrix3::Zero();  ///< about the centroid
};

struct FitError {
  double rms = 0;         ///< of the distances of the data's points from the body's surface
  double to_body = 0;     ///< largest distance of a point of the data from the body's surface
  double to_data = 0;     ///< largest distance of a point of the body's surface from the data
  Solid body;             ///< of the union of the bodies: what they share counts once
  double body_error = 0;  ///< standard error of the volume, where it is an integral by random points; 0: closed form
  Solid data;             ///< of the mesh where it is closed, of the convex hull otherwise
  bool is_hull = false;   ///< whether `data` is that of the convex hull
};

/// Whether the data are a mesh that encloses a volume: every edge is of triangles that run along it both ways. Flat triangles,
/// whose corners are on a line, do not count unless they are needed.
bool is_closed(const Data& data);

/// Points of the union's surface: of `count` on each body, the same always, those that no other body contains.
std::vector<Vector3> free_surface(std::span<const DistanceFunction> functions, std::size_t count);

struct VolumeIntegral {
  Solid solid;
  double volume_error = 0;  ///< standard error of the volume
};

/// Of the union of bodies, by random points, always the same.
VolumeIntegral integrate_union(std::span<const Body> bodies);

/// Hausdorff's distances are over the vertices of the data (and random points of its triangles), and over random points of the
/// bodies' surfaces that no other body covers: lower bounds, short of the true ones by at most the points' spacing.
FitError find_error(std::span<const Body> bodies, const Data& data);

}  // namespace fit
