// The bodies of the study.
#pragma once

#include <ode/ode.h>

#include <string>
#include <vector>

namespace resting {

/// A family of bodies of half-height h. All but the user's shapes have an exponent. Lying bodies are round across their length and
/// roll.
enum class BodyKind {
  Brick,         ///< half-axes 2 h, 1.4 h, h, the same exponent in both sections
  RoundedBrick,  ///< the same with edges rounded by h / 4
  Coin,          ///< exponents (2, e), radius 2 h, upright
  Can,           ///< exponents (2, e), radius h, half-length 5 h, lying
  ShortCan,      ///< the same with half-length h
  Pillow,        ///< exponents (e, 2), half-axes h, 3 h, h: straight in one direction and round across it
  RoundedCan,    ///< a can of half-length 3 h with edges rounded by h / 4
  Cone,          ///< a superovoid with exponents (2, e) and tapers 0.3, half-length 3 h, lying
  UserBrick,     ///< a brick with sharp edges, defined by its support function and boundary point
  UserCylinder,  ///< a lying cylinder with sharp edges and half-length 3 h, defined likewise
};

struct NamedKind {
  std::string name;
  BodyKind kind;
};

/// All kinds, with their names on the command line.
const std::vector<NamedKind>& body_kinds();

bool lies_on_its_side(BodyKind kind);
bool has_exponent(BodyKind kind);

/// Makes a geom of Supernormal with its mass. `exponent` applies if the kind has one; lengths are in m. Throws std::runtime_error.
dGeomID create_body(dSpaceID space, BodyKind kind, double exponent, double half_height, dMass& mass);

/// Makes the dBox or dCylinder of the same size, with its mass.
dGeomID create_counterpart(dSpaceID space, BodyKind kind, double half_height, dMass& mass);

/// The height of the lowest point of a geom made by either function above, m.
double lowest_point(dGeomID geom);

}  // namespace resting
