// The bodies of grains at one time, for formats that know one body a particle.
#pragma once

#include <vector>

#include "frame.hpp"

namespace falling_particles {

/// A body of a grain at one time, in the world's frame, at its true size.
struct ShownComponent {
  std::size_t index;                 ///< its own for the whole run: of all parts, also of grains that are gone
  std::size_t grain;                 ///< index of the grain in the frame
  ConvexBody body;                   ///< scaled
  Point position;                    ///< m, of the body's origin
  std::array<double, 4> quaternion;  ///< w, x, y, z; unit
  Point velocity;                    ///< m/s, of the body's origin
  Point angular_velocity;            ///< rad/s
};

/// In the order of the grains that are there: one of each, but all of a compound.
std::vector<ShownComponent> shown_components(const Frame& frame, const Contents& contents);

}  // namespace falling_particles
