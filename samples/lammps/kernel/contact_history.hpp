// The state of a pair of bodies between two steps.
#pragma once

#include <Eigen/Core>

#include "kernel/slider.hpp"

namespace granular {

/// The history of a pair, in the world frame, for body 1.
struct ContactHistory {
  Vector3 normal = Vector3::Zero();   ///< of the last query, from body 1 to body 2; zero if there was none
  Vector3 sliding = Vector3::Zero();  ///< m; deflection of the tangential spring
  Vector3 rolling = Vector3::Zero();  ///< rad; deflection of the rolling spring
  double stiffness = 0;               ///< N/m; of the tangential spring in the last step

  static constexpr int kSize = 10;  ///< how many numbers store one history

  bool has_normal() const { return normal != Vector3::Zero(); }
  void release_springs() {
    sliding.setZero();
    rolling.setZero();
    stiffness = 0;
  }

  /// Reads and writes a history as an array of numbers.
  static ContactHistory load(const double* values) {
    return {Vector3::Map(values), Vector3::Map(values + 3), Vector3::Map(values + 6), values[9]};
  }
  void store(double* values) const {
    Vector3::Map(values) = normal;
    Vector3::Map(values + 3) = sliding;
    Vector3::Map(values + 6) = rolling;
    values[9] = stiffness;
  }
};

}  // namespace granular
