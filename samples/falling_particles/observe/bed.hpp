// Height, volume fraction and bulk density of a bed of grains, and the angle of repose of a heap.
#pragma once
#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "common/random.hpp"
#include "model/container.hpp"
#include "model/geometry.hpp"
#include "model/hopper.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// The slab in which the volume fraction is measured, relative to the height of the bed. It is above the layer at the floor, which
/// is partly empty under round grains, and below the uneven surface.
constexpr double kSlabBottom = 0.05;
constexpr double kSlabTop = 0.80;

struct Bed {
  double height;           ///< m; height of a homogeneous bed whose volume has the same mean height as the grains' volume
  double volume_fraction;  ///< fraction of the slab, from wall to wall, that lies within a grain; an overlap counts once
  double
      standard_error;   ///< standard error of volume_fraction for independent sampling points; stratified points have a smaller one
  double bulk_density;  ///< kg/m^3, of the slab

  void serialize(auto& archive) { archive(height, volume_fraction, standard_error, bulk_density); }
};

/// Measures the bed in a box. It samples the slab at stratified random points with snGeomPointDepth.
Bed measure_bed(const World& world, const Box& box, Random& random);
/// Measures the bed in a closed hopper; heights are above the outlet.
Bed measure_bed(const World& world, const Hopper& hopper, Random& random);

struct Line {
  double slope, at_zero;
  double error;  ///< standard error of the slope
};

/// The line of least squares through at least three points.
Line fit(const std::vector<std::array<double, 2>>& points);

/// The surface of grains, which vertical rays find.
class Tops {
 public:
  void add(dGeomID geom) { tops_.push_back({geom, aabb_of(geom)}); }
  /// m, the highest point of the added geoms on a vertical line, if it is above `least`.
  std::optional<double> height_at(double x, double y, double least) const;

 private:
  struct Top {
    dGeomID geom;
    Aabb aabb;
  };
  std::vector<Top> tops_;
  std::unique_ptr<dxGeom, decltype(&dGeomDestroy)> ray_{dCreateRay(nullptr, 1), dGeomDestroy};
};

/// The section of a heap's flank that is measured, as fractions of the base's radius: without the rounded top and the foot.
constexpr double kFlankFrom = 0.25;
constexpr double kFlankTo = 0.85;

struct Heap {
  double angle;           ///< degrees, of repose: between flank and horizontal, mean of the sectors
  double standard_error;  ///< degrees, from the scatter of the sectors
  double height;          ///< m, of the straight flank at the axis, above the base
  std::size_t grains;     ///< number of grains with centres above the base
  bool has_flank;         ///< whether a grain lies where the flank is measured; otherwise there is no angle and no height
};

/// Measures the heap on a horizontal, round base. Vertical rays find the surface. The mean height on each arc of a sector is fitted
/// by a straight line in the distance from the axis. `centre` and `radius` of the base are in m.
Heap measure_heap(const World& world, const Point& centre, double radius);

}  // namespace falling_particles
