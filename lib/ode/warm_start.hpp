// The last normal of each pair, where the next query of the pair starts.
#pragma once

#include <cstdint>

#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// A pair as the table knows it. Addresses would do for identity, but they change from run to run and with them which entries
/// push out which: the same scene would give other last digits. Serial numbers of our geoms do not change.
struct PairKey {
  std::uint32_t body = 0;     ///< serial number of the body whose frame the normal is in; 0 is nobody
  std::uint32_t partner = 0;  ///< see the two functions below

  /// For two of our bodies, serial1 < serial2; the normal is in the frame of body 1.
  static PairKey of_bodies(std::uint32_t serial1, std::uint32_t serial2) { return {serial1, serial2 - serial1}; }

  /// For a partner that has no serial number (ODE's own geoms): where it is seen from the body, `direction` in the body's frame,
  /// of any length. What was there at the last step is most likely the same geom; if it is not, its normal is a guess as any.
  static PairKey of_direction(std::uint32_t serial, const Vector3& direction);
};

void set_warm_start(bool on) noexcept;

/// Copies the remembered unit normal of the pair and returns true; false when there is none or warm start is off.
bool recall_normal(const PairKey& key, Vector3& normal) noexcept;

/// Does nothing when warm start is off or there is no memory.
void remember_normal(const PairKey& key, const Vector3& normal) noexcept;

}  // namespace supernormal::ode
