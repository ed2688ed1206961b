// Queries of a dHeightfield through ODE's public interface: it has no function for the samples, but ODE's own geoms can be
// collided with it.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// The precision of dReal: the numbers that ODE takes and returns are rounded to it.
inline constexpr double kRealEpsilon = double{std::numeric_limits<dReal>::epsilon()};

/// Width of the border that is avoided, relative to the extent: ODE 0.16 aborts if a geom reaches beyond the far border by a
/// rounding error (heightfield.cpp, dIASSERT(nMinX < nMaxX)), and finds no rays on the border.
inline constexpr double kBorder = std::max(1e-9, 8 * kRealEpsilon);
inline constexpr double kInside = 1 - 10 * kBorder;

/// The plane of the triangle at some (x, z).
struct Facet {
  double x = 0, z = 0;                ///< m; the point at which the plane was found
  double height = 0;                  ///< m; y of the surface there
  double rounding = 0;                ///< m; rounding error of the height, from the terms that ODE adds up for it
  Vector3 normal = Vector3::UnitY();  ///< unit, upward

  Vector3 place() const { return {x, height, z}; }

  /// The height y of the plane at (at_x, at_z), m.
  double height_at(double at_x, double at_z) const {
    return height - (normal.x() * (at_x - x) + normal.z() * (at_z - z)) / normal.y();
  }
};

/// A private geom with the samples of a heightfield, non-placeable, so that everything is in the heightfield's own frame (origin
/// in the middle, y up) and free of the rounding of a pose, and the geoms it is probed with. All of them are kept by the thread:
/// they stay usable when ODE is closed and initialised again.
///
/// ODE keeps scratch memory in the heightfield data: at any time only one thread may collide anything with the same data.
class HeightfieldProbe {
 public:
  /// This thread's probe, with the samples of `heightfield`.
  static HeightfieldProbe& looking_at(dGeomID heightfield);

  HeightfieldProbe(const HeightfieldProbe&) = delete;
  HeightfieldProbe(HeightfieldProbe&&) = delete;
  HeightfieldProbe& operator=(const HeightfieldProbe&) = delete;
  HeightfieldProbe& operator=(HeightfieldProbe&&) = delete;

  dHeightfieldDataID data() const { return data_; }

  /// Half of the extent in x and z, m; infinite for a heightfield that repeats.
  double half_width() const { return half_width_; }
  double half_depth() const { return half_depth_; }
  bool is_infinite() const;

  /// An upper bound of the samples, m; infinite when ODE does not know (height callback without dGeomHeightfieldDataSetBounds).
  double max_height() const { return max_height_; }

  /// Returns false where there is no surface: beyond the border, on it (some 1e-9 of the extent), or where a sample is not a
  /// number. `scale` (m) is the length that matters to the caller.
  bool find_facet(double x, double z, double scale, Facet& facet);

  /// Adds samples within `radius` (m) of the place's (x, z), at their exact places: as a rule all of them, but ODE omits those of
  /// some planes, above all that of the triangle there. The place is no more than 5e8 radii above or below the surface. Returns
  /// false when there are more than it can list.
  bool list_samples(const Vector3& place, double radius, std::vector<Vector3>& samples);

 private:
  HeightfieldProbe();
  ~HeightfieldProbe();

  bool cast_down(double x, double z, double start, Facet& facet);

  dHeightfieldDataID data_ = nullptr;
  dGeomID heightfield_, ray_, capsule_;
  double half_width_ = 0, half_depth_ = 0, max_height_ = 0;
  std::vector<dContactGeom> contacts_;
};

}  // namespace supernormal::ode
