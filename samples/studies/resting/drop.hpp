// A body that falls onto a floor, and how it comes to rest.
#pragma once

#include <ode/ode.h>

#include <array>
#include <memory>

#include "body_kind.hpp"

namespace resting {

enum class FloorKind { Plane, Box, Mesh, Heightfield, Superellipsoid };

/// A row of the matrix: everything that a program may choose, and the size of the body. For everything else ODE's defaults hold.
struct Row {
  FloorKind floor = FloorKind::Plane;
  BodyKind kind = BodyKind::Brick;
  double exponent = 0;             ///< 0: the dBox or dCylinder of the same size
  double half_height = 0.05;       ///< m
  double step = 0.01;              ///< s
  int room = 8;                    ///< contacts a pair
  double correcting_velocity = 0;  ///< m/s; 0: without limit
  bool looks_ahead = false;        ///< contacts before overlap; a dBox or dCylinder has none
};

/// The attitudes in which it is dropped.
struct Attitudes {
  int draw = 0;             ///< another number turns about other axes
  double largest_tilt = 6;  ///< degrees; the drops of a row are tilted by 1 degree to this
};

/// How one drop ended.
struct Rest {
  bool is_asleep = false;  ///< within ten seconds
  double time = 0;         ///< s; until it fell asleep
  double height = 0;       ///< height of the centre in the end, half-heights
  double lowest = 0;       ///< height of the lowest point in the end, half-heights: negative in the floor
};

inline constexpr int kDrops = 24;  ///< they start in different attitudes

/// Drops the body, number 0 to kDrops - 1, from three half-heights onto a floor of Coulomb friction 0.5.
Rest drop(const Row& row, const Attitudes& attitudes, int number);

}  // namespace resting
