// Poses and vectors of ODE in the form of the core.
#pragma once

#include "supernormal/proximity/pose.hpp"
#include "support/ode_fixture.hpp"

namespace supernormal::test {

inline Eigen::Vector3d to_eigen(const Vec& v) { return {v[0], v[1], v[2]}; }

inline Pose pose_of(dGeomID geom) {
  const dReal* const rotation = dGeomGetRotation(geom);
  Pose pose{to_eigen(to_vec(dGeomGetPosition(geom))), {}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.rotation(row, column) = double{rotation[4 * row + column]};
  }
  return pose;
}

}  // namespace supernormal::test
