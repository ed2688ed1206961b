// The bodies of the battery of checks.
#pragma once

#include <cmath>

#include "support/ode_fixture.hpp"

namespace supernormal::test {

inline dReal ellipsoid_support(const void* user, const dReal direction[3]) {
  const auto* const axes = static_cast<const dReal*>(user);
  return std::hypot(axes[0] * direction[0], axes[1] * direction[1], axes[2] * direction[2]);
}

inline void ellipsoid_point(const void* user, const dReal direction[3], dReal point[3]) {
  const auto* const axes = static_cast<const dReal*>(user);
  const dReal h = ellipsoid_support(user, direction);
  for (int k = 0; k < 3; ++k) point[k] = axes[k] * axes[k] * direction[k] / h;
}

inline dReal user_axes[3] = {dReal(0.6), dReal(0.9), dReal(0.4)};

/// Draws a body of any kind: ellipsoids; round, boxy and pointed superellipsoids; rounded bodies; user shapes.
inline dGeomID draw_body(Random& random) {
  const auto axis = [&] { return dReal(random.uniform(0.2, 1)); };
  const auto exponent = [&] { return dReal(1 + 0.02 * std::pow(1e4, random.uniform(0, 1))); };  // 1.02…201
  const dReal a = axis(), b = axis(), c = axis(), delta = exponent(), epsilon = exponent();
  const double sort = random.uniform(0, 6);
  const snShape shape = {ellipsoid_support, ellipsoid_point, nullptr, user_axes, nullptr};
  const dGeomID geom = sort < 1   ? snCreateEllipsoid(nullptr, a, b, c)
                       : sort < 2 ? snCreateConvex(nullptr, &shape)
                                  : snCreateSuperellipsoid(nullptr, a, b, c, delta, epsilon);
  if (sort > 5) snGeomSetRounding(geom, dReal(random.uniform(0.01, 0.3)));
  random.turn(geom);
  return geom;
}

}  // namespace supernormal::test
