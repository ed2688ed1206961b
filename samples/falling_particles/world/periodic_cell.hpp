// Periodic boundary conditions.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "model/periodic.hpp"

namespace falling_particles {

class World;
struct Grain;

/// Periodic boundaries for ODE, which has none. A grain that sticks out of the cell gets an image, a body and a geom of its own, at
/// every place where it comes in again, up to seven of them. Grain and images share mass and inertia evenly and are tied to one
/// velocity and one spin by six constraint rows without lever arms; so forces on an image act on the grain, in the same step. The
/// cell may be periodic along some axes only.
///
/// A point of contact lies in the cell exactly once, whichever grains and images meet there: only contacts in the cell count.
class PeriodicCell {
 public:
  PeriodicCell(const World& world, const PeriodicAxes& axes);
  ~PeriodicCell();
  PeriodicCell(const PeriodicCell&) = delete;
  PeriodicCell& operator=(const PeriodicCell&) = delete;

  const PeriodicAxes& axes() const { return axes_; }
  /// m, along x, y and z, as scale() has left them; 0 where the cell is not periodic.
  Point lengths() const;
  void set_lengths(const Point& lengths);
  double side() const { return axes_[0]->length; }  ///< m, of a cell that is a cube

  bool contains(const dVector3 point) const;
  /// The image of the point in the cell.
  Point wrapped(const Point& point) const { return falling_particles::wrapped(axes_, point); }

  /// Moves grains that have left into the cell, the lower ends of their bounding boxes that is, and sets up the images; call it
  /// before collision. Throws std::runtime_error when the cell is below twice the width of a grain: a grain might meet itself.
  void place_images();
  /// Gives a grain and its images the way that one of them has gone since place_images(): that of the effects, which bring grains
  /// to touch that will bounce. Call it before a step.
  void share_ways();
  /// Gives grains the mean motion of themselves and their images, between which the solver leaves a small difference; call it
  /// after a step.
  void gather();
  /// The world has a grain more.
  void add_last() { families_.emplace_back(); }
  /// The world's grain of that index goes, and its images with it.
  void remove(std::size_t index);

  /// Scales the cell, a cube from the origin, and the centres of the grains in it, but not their sizes.
  void scale(double factor);

 private:
  struct Image {
    dBodyID body;
    dJointID same_velocity;
    dJointID same_spin;
  };
  double shift_along(unsigned mask, std::size_t axis) const;

  static constexpr unsigned kMasks = 8;  // axes along which an image is shifted: bit 0 for x, 1 for y, 2 for z
  struct Family {
    std::array<std::optional<Image>, kMasks> images;  // [0], the grain itself, stays empty; made when first needed
    unsigned shown = 0;                               // axes along which the grain sticks out
    Point placed = {};                                // m, of the grain, by place_images()
    unsigned size = 1;                                // number of the grain and its images that are in use
  };

  Image make_image(const Grain& grain) const;
  void show(const Grain& grain, Family& family, unsigned mask);
  static void hide(const Image& image);
  static void destroy(Family& family);
  static void share_mass(const Grain& grain, Family& family, unsigned size);

  const World& world_;
  PeriodicAxes axes_;
  std::vector<Family> families_;  // in the order of the world's bodies
};

}  // namespace falling_particles
