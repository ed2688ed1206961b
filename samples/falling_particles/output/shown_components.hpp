// The convex bodies of grains at one time, for formats with one body per particle.
#pragma once

#include <vector>

#include "frame.hpp"

namespace falling_particles {

/// A convex body of a grain at one time, in the world's frame, at its true size.
struct ShownComponent {
  std::size_t index;                 ///< unique in a run: counted over the components of all grains, removed ones included
  std::size_t grain;                 ///< index of the grain in the frame
  ConvexBody body;                   ///< scaled
  Point position;                    ///< m, of the body's origin
  std::array<double, 4> quaternion;  ///< w, x, y, z; unit
  Point velocity;                    ///< m/s, of the body's origin
  Point angular_velocity;            ///< rad/s
};

/// In the order of the present grains: one body of each, but all components of a compound.
std::vector<ShownComponent> shown_components(const Frame& frame, const Contents& contents);

}  // namespace falling_particles
