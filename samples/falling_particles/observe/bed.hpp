// Height, volume fraction and bulk density of a bed of grains.
#pragma once

#include "common/random.hpp"
#include "model/container.hpp"
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

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(height, volume_fraction, standard_error, bulk_density);
  }
};

/// Measures the bed in a box. It samples the slab at stratified random points with snGeomPointDepth.
Bed measure_bed(const World& world, const Box& box, Random& random);
/// Measures the bed in a closed hopper; heights are above the outlet.
Bed measure_bed(const World& world, const Hopper& hopper, Random& random);

}  // namespace falling_particles
