// The bodies of the study.
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

/// Makes a geom of Supernormal with its mass. `exponent` applies if the kind has one; lengths are in m. Throws std::runtime_error.
dGeomID create_body(dSpaceID space, const BodyKind& kind, double exponent, double half_height, dMass& mass);

/// Makes the dBox or dCylinder of the same size, with its mass.
dGeomID create_counterpart(dSpaceID space, const BodyKind& kind, double half_height, dMass& mass);

/// The height of the lowest point of a geom made by either function above, m.
double lowest_point(dGeomID geom);

}  // namespace resting
