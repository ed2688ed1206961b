// Periodic boundary conditions, and the compression of grains in a periodic cell.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/container.hpp"
#include "model/scene.hpp"

namespace falling_particles {

class World;
struct Grain;

/// Periodic boundaries for ODE, which has none. A grain that extends beyond the cell re-enters it in up to seven places. In each of
/// them it gets an image, a body with its own geoms. The grain and its images share mass and inertia evenly. Six constraint rows
/// without lever arms give them equal velocities and spins. So forces on an image act on the grain in the same step. The cell may
/// be periodic along some axes only.
///
/// A contact point lies in the cell exactly once, whichever grains and images meet there. So only contacts in the cell count.
class PeriodicCell {
 public:
  PeriodicCell(const World& world, const PeriodicAxes& axes);
  ~PeriodicCell();
  PeriodicCell(const PeriodicCell&) = delete;
  PeriodicCell& operator=(const PeriodicCell&) = delete;

  const PeriodicAxes& axes() const { return axes_; }
  /// m, along x, y and z, after scale(); 0 along axes that are not periodic.
  Point lengths() const;
  void set_lengths(const Point& lengths);
  double side() const { return axes_[0]->length; }  ///< m, of a cubic cell

  bool contains(const dVector3 point) const;
  /// The image of the point in the cell.
  Point wrapped(const Point& point) const { return falling_particles::wrapped(axes_, point); }

  /// Moves the lower corners of the grains' bounding boxes into the cell, and places the images. Call it before collision. Throws
  /// std::runtime_error when the cell is narrower than two widths of a grain, which could then meet itself.
  void place_images();
  /// Gives a grain and its images the sum of their displacements since place_images(). These are displacements by effects, which
  /// move bouncing grains into contact. Call it before a step.
  void share_ways();
  /// Gives each grain the mean motion of itself and its images, which the solver makes equal only approximately. Call it after a
  /// step.
  void gather();
  /// Call it when the world has got one more grain.
  void add_last() { families_.emplace_back(); }
  /// Removes the images of the world's grain `index`. Call it when the grain is removed.
  void remove(std::size_t index);

  /// Scales a cubic cell about the origin, and the centres of the grains in it, but not their sizes.
  void scale(double factor);

 private:
  struct Image {
    dBodyID body;
    dJointID same_velocity;
    dJointID same_spin;
  };
  double shift_along(unsigned mask, std::size_t axis) const;

  static constexpr unsigned kMasks = 8;  // sets of axes along which an image is shifted: bit 0 for x, 1 for y, 2 for z
  struct Family {
    std::array<std::optional<Image>, kMasks> images;  // made when first needed; [0], the grain itself, stays empty
    unsigned shown = 0;                               // axes along which the grain extends beyond the cell
    Point placed = {};                                // m, position of the grain after place_images()
    unsigned size = 1;                                // number of bodies in use: the grain and its images
  };

  Image make_image(const Grain& grain) const;
  void show(const Grain& grain, Family& family, unsigned mask);
  static void hide(const Image& image);
  static void destroy(Family& family);
  static void share_mass(const Grain& grain, Family& family, unsigned size);

  const World& world_;
  PeriodicAxes axes_;
  std::vector<Family> families_;  // in the order of the world's grains
};

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
