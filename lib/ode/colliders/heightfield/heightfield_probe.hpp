// What can be learned of a dHeightfield through ODE's public interface: there is none to its samples, but ODE's own geoms may be
// collided with it.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// Of dReal: what ODE is told, and tells, is rounded to it.
inline constexpr double kRealEpsilon = double{std::numeric_limits<dReal>::epsilon()};

/// Of the extent: ODE 0.16 aborts on what reaches beyond the far border by a rounding error (heightfield.cpp,
/// dIASSERT(nMinX < nMaxX)), and answers no rays on the border.
inline constexpr double kBorder = std::max(1e-9, 8 * kRealEpsilon);
inline constexpr double kInside = 1 - 10 * kBorder;

/// The plane of the triangle at some (x, z).
struct Facet {
  double x = 0, z = 0;                ///< m; where it was asked for
  double height = 0;                  ///< m; y of the surface there
  double rounding = 0;                ///< m; of the height, by what ODE adds up for it
  Vector3 normal = Vector3::UnitY();  ///< unit, upward

  /// y of the plane above (at_x, at_z), m.
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
  /// This thread's, looking at the samples of `heightfield`.
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

  /// No sample is above it, m; infinite when ODE does not know (height callback without dGeomHeightfieldDataSetBounds).
  double max_height() const { return max_height_; }

  /// False where there is no surface: beyond the border, on it (some 1e-9 of the extent), or where a sample is not a number.
  /// `scale` (m) is the length that matters to the caller.
  bool find_facet(double x, double z, double scale, Facet& facet);

  /// Adds samples within `radius` (m) of the facet's (x, z), at their exact places: as a rule all of them, but ODE keeps those of
  /// some planes to itself, above all that of the facet. False when there are more than it can list.
  bool list_samples(const Facet& facet, double radius, std::vector<Vector3>& samples);

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
