#pragma once

#include "random.hpp"
#include "scene.hpp"
#include "world.hpp"

namespace falling_particles {

/// The slab in which the volume fraction is taken, relative to the bed's height: above the floor's own layer as far as it is
/// empty under round grains, and below the uneven surface.
constexpr double kSlabBottom = 0.05;
constexpr double kSlabTop = 0.80;

struct Bed {
  double height;           ///< m; twice the mean height of the grains' volume, which is exact for a homogeneous bed
  double volume_fraction;  ///< share of the slab, from wall to wall, that lies within a grain; an overlap counts once
  double standard_error;   ///< of volume_fraction, as if the sampling points were independent (they are stratified: less)
};

/// Samples the slab with stratified random points and snGeomPointDepth.
Bed measure_bed(const World& world, const Box& box, Random& random);

}  // namespace falling_particles
