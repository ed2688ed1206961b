// The relative curvature of two bodies at their contact.
#pragma once

namespace supernormal {

/// Principal values of the relative curvature K1 + K2, 1/m. The gap between the bodies grows as (smaller x^2 + larger y^2) / 2.
struct ContactCurvature {
  double smaller = 0;  ///< 1/m; along the direction in which the bodies separate most slowly
  double larger = 0;   ///< 1/m; across this direction
};

}  // namespace supernormal
