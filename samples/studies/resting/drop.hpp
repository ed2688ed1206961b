// The bodies of the study, and one that falls onto a floor and comes to rest.
#pragma once

#include <ode/ode.h>

#include <array>
#include <vector>

namespace resting {

/// A family of bodies of half-height h. All but the user's shapes have an exponent e. Lying bodies are round across their length
/// and roll.
struct BodyKind {
  const char* name;                 ///< on the command line
  bool is_box;                      ///< whether its counterpart is a dBox, and no dCylinder
  std::array<double, 3> half_axes;  ///< in half-heights, in the body's frame, whose z-axis is the axis of a round section
  bool has_delta = false, has_epsilon = false;  ///< whether the exponent of the section, and the one along z, is e instead of 2
  double rounding = 0;                          ///< radius of the rounded edges, in half-heights
  double taper = 0;                             ///< of a superovoid

  /// Without an exponent: defined by its support function and boundary point, with sharp edges.
  bool has_exponent() const { return has_delta || has_epsilon; }
  bool lies_on_its_side() const { return half_axes[2] >= half_axes[0]; }
};

/// All kinds.
const std::vector<BodyKind>& body_kinds();

enum class FloorKind { Plane, Box, Mesh, Heightfield, Superellipsoid };

/// A row of the matrix: all choices of a program, and the size of the body. Everything else has ODE's defaults.
struct Row {
  FloorKind floor = FloorKind::Plane;
  BodyKind kind = body_kinds().front();
  double exponent = 0;             ///< 0: the dBox or dCylinder of the same size
  double half_height = 0.05;       ///< m
  double step = 0.01;              ///< s
  int room = 8;                    ///< max_contacts
  double correcting_velocity = 0;  ///< m/s; 0: unlimited
  bool looks_ahead = false;        ///< contacts before overlap; a dBox or dCylinder has none
};

/// The orientations of the drops.
struct Orientations {
  int draw = 0;             ///< another number gives other axes
  double largest_tilt = 6;  ///< degrees; the drops of a row are tilted by 1 degree to this
};

/// The outcome of one drop.
struct Rest {
  bool is_asleep = false;  ///< whether it fell asleep within ten seconds
  double time = 0;         ///< s; until it fell asleep
  double height = 0;       ///< height of the centre at the end, half-heights
  double lowest = 0;       ///< height of the lowest point at the end, half-heights; negative: in the floor
};

inline constexpr int kDrops = 24;  ///< they start in different orientations

/// Drops the body, number 0 to kDrops - 1, from three half-heights onto a floor of Coulomb friction 0.5.
Rest drop(const Row& row, const Orientations& orientations, int number);

}  // namespace resting
