// Compression of grains in a periodic cell until they jam.
#pragma once

#include <ode/ode.h>

#include <span>

#include "model/scene.hpp"
#include "periodic_cell.hpp"
#include "world.hpp"

namespace falling_particles {

/// The mean overlap of overlapping grains. The overlap of a pair is the relative amount by which both would have to shrink to
/// touch: depth / distance of their parallel tangent planes from centre to centre along the normal. A contact counts once, whatever
/// its number of points.
struct MeanOverlap {
  double relative = 0;
  std::size_t contacts = 0;  ///< pairs of overlapping grains; a pair that meets in two places of the cell counts twice
};
/// `contacts` must be sorted by their grains.
MeanOverlap measure_mean_overlap(std::span<const dContactGeom> contacts);

struct Packing {
  double side;             ///< m, of the cell
  double volume_fraction;  ///< volume of the grains / volume of the cell; overlaps count twice
  double at_contact;       ///< volume_fraction after shrinking all grains by the mean overlap
  MeanOverlap overlap;
  double target_overlap;      ///< relative, of the mean overlap
  double contacts_per_grain;  ///< mean number of grains that a grain overlaps, rattlers included
};

/// Compresses the grains in a periodic cell until they jam. The solver pushes overlapping grains apart, and every step removes a
/// fraction of the resulting velocity. The cell shrinks while the mean overlap is below its target and grows while it is above. The
/// target decreases, so that the jamming point is approached from above. In the last fifth of the time, the target is constant and
/// every step removes all velocity. So the forces reach equilibrium.
///
/// The method of compressing and relaxing is from C. S. O'Hern, L. E. Silbert, A. J. Liu, S. R. Nagel, Jamming at zero temperature
/// and zero applied stress: the epitome of disorder, Phys. Rev. E 68 (2003) 011306. G. W. Delaney, P. W. Cleary, The packing
/// properties of superellipsoids, EPL 89 (2010) 34002, grow superellipsoids in a periodic cell.
class Compressor {
 public:
  Compressor(const World& world, PeriodicCell& cell, const Compression& compression, double duration);

  /// Adjusts the cell after a step. `contacts` are the contacts that the step has resolved.
  void after_step(double time, std::span<const dContactGeom> contacts);

  const Packing& packing() const { return packing_; }

 private:
  const World& world_;
  PeriodicCell& cell_;
  const Compression& compression_;
  double duration_;
  double grain_volume_ = 0;  // m^3, of all grains
  Packing packing_;
};

}  // namespace falling_particles
