// Queries of a dHeightfield through the public interface of ODE. ODE has no function that returns samples, but the heightfield can
// be collided with other geoms.
#pragma once

#include <ode/ode.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// The precision of dReal. ODE rounds its inputs and outputs to it.
inline constexpr double kRealEpsilon = double{std::numeric_limits<dReal>::epsilon()};

/// Relative width of the border to avoid. ODE 0.16 aborts if a geom passes the far border by a rounding error (heightfield.cpp,
/// dIASSERT(nMinX < nMaxX)). It also finds no ray hits on the border.
inline constexpr double kBorder = std::max(1e-9, 8 * kRealEpsilon);
inline constexpr double kInside = 1 - 10 * kBorder;

/// The plane of the triangle at some (x, z).
struct Facet {
  double x = 0, z = 0;                ///< m; where the plane was found
  double height = 0;                  ///< m; y of the surface there
  double rounding = 0;                ///< m; rounding error of the height, from the terms that ODE adds
  Vector3 normal = Vector3::UnitY();  ///< unit, upward

  Vector3 place() const { return {x, height, z}; }

  /// The height y of the plane at (at_x, at_z), m.
  double height_at(double at_x, double at_z) const {
    return height - (normal.x() * (at_x - x) + normal.z() * (at_z - z)) / normal.y();
  }
};

/// A private geom with the samples of a heightfield, and the geoms that probe it. The private geom is not placeable: everything is
/// in the frame of the heightfield (origin in the middle, y up), without the rounding of a pose. Each thread keeps its geoms; they
/// survive dCloseODE and dInitODE.
///
/// ODE keeps scratch memory in the heightfield data: two threads must not collide with the same data at once.
class HeightfieldProbe {
 public:
  /// The probe of this thread, with the samples of `heightfield`.
  static HeightfieldProbe& looking_at(dGeomID heightfield);

  HeightfieldProbe();  // of looking_at(); a thread needs no other
  ~HeightfieldProbe();
  HeightfieldProbe(const HeightfieldProbe&) = delete;
  HeightfieldProbe(HeightfieldProbe&&) = delete;
  HeightfieldProbe& operator=(const HeightfieldProbe&) = delete;
  HeightfieldProbe& operator=(HeightfieldProbe&&) = delete;

  dHeightfieldDataID data() const { return data_; }

  /// Half of the extent in x and z, m; infinite for a heightfield that repeats.
  double half_width() const { return half_width_; }
  double half_depth() const { return half_depth_; }
  bool is_infinite() const;

  /// An upper bound of the samples, m. Infinite when ODE has none (height callback without dGeomHeightfieldDataSetBounds).
  double max_height() const { return max_height_; }

  /// Returns false where there is no surface: beyond or on the border (some 1e-9 of the extent), or where a sample is NaN. `scale`
  /// (m, > 0) is the length scale of the caller.
  bool find_facet(double x, double z, double scale, Facet& facet);

  /// Adds the samples within `radius` (m) of the place in (x, z), with their exact coordinates. ODE omits the samples of some
  /// planes, above all of the triangle there. The place must be within 5e8 radii above or below the surface. Returns false when
  /// there are too many samples to list.
  bool list_samples(const Vector3& place, double radius, std::vector<Vector3>& samples);

 private:
  bool cast_down(double x, double z, double start, Facet& facet);

  dHeightfieldDataID data_ = nullptr;
  dGeomID heightfield_, ray_, capsule_;
  double half_width_ = 0, half_depth_ = 0, max_height_ = 0;
  std::vector<dContactGeom> contacts_;
};

}  // namespace supernormal::ode
