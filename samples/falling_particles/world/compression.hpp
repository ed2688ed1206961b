// Compression of grains in a periodic cell until they jam.
#pragma once

#include <ode/ode.h>

#include <span>

#include "model/scene.hpp"
#include "periodic_cell.hpp"
#include "world.hpp"

namespace falling_particles {

/// The mean overlap of grains that meet: how much both would have to shrink to touch, depth / distance of their parallel tangent
/// planes from centre to centre along the normal. However many points a contact has, it counts once.
struct MeanOverlap {
  double relative = 0;
  std::size_t contacts = 0;  ///< pairs of grains that overlap; two that meet in two places of the cell count twice
};
/// `contacts` are sorted by their grains.
MeanOverlap measure_mean_overlap(std::span<const dContactGeom> contacts);

struct Packing {
  double side;             ///< m, of the cell
  double volume_fraction;  ///< volume of the grains / that of the cell: volume that two grains share counts twice
  double at_contact;       ///< volume_fraction of grains shrunk, all alike, until they no longer overlap in the mean
  MeanOverlap overlap;
  double target_overlap;      ///< relative, for the mean
  double contacts_per_grain;  ///< grains that a grain overlaps, mean; rattlers included
};

/// Compresses the grains in a periodic cell until they jam. They are moved by the push out of their overlaps, and every step
/// takes away a share of the resulting speed. The cell shrinks while the mean overlap is below its target and grows while it is
/// above; the target falls, so that the end is approached from above, at the onset of jamming. For the last fifth of the time it
/// stays, and all speed is taken away in every step, so that the forces find their balance.
///
/// The method of compressing and relaxing is that of C. S. O'Hern, L. E. Silbert, A. J. Liu, S. R. Nagel, Jamming at zero
/// temperature and zero applied stress: the epitome of disorder, Phys. Rev. E 68 (2003) 011306; G. W. Delaney, P. W. Cleary, The
/// packing properties of superellipsoids, EPL 89 (2010) 34002, grow superellipsoids in a periodic cell.
class Compressor {
 public:
  Compressor(const World& world, PeriodicCell& cell, const Compression& compression, double duration);

  /// Adjusts the cell after a step; `contacts` are those that the step has resolved.
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
