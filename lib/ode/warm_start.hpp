// The last normal of each pair, where the next query of the pair starts.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "supernormal/shapes/shape.hpp"
#include "supernormal/solvers/pose.hpp"

namespace supernormal::ode {

/// A pair as the table knows it. Addresses would do for identity, but they change from run to run and with them which entries
/// push out which: the same scene would give other last digits. Serial numbers of our geoms do not change.
struct PairKey {
  std::uint32_t body = 0;     ///< serial number of the body whose frame the normal is in; 0 is nobody
  std::uint32_t partner = 0;  ///< see the two functions below

  /// For two of our bodies, serial1 < serial2; the normal is in the frame of body 1.
  static PairKey of_bodies(std::uint32_t serial1, std::uint32_t serial2) { return {serial1, serial2 - serial1}; }

  /// For a partner that has no serial number (ODE's own geoms): where it is seen from the body, `direction` in the body's frame,
  /// of any length.
  static PairKey of_direction(std::uint32_t serial, const Vector3& direction);
};

/// Where the partner is, in the frame of the body.
struct RelativePose {
  Vector3 offset = Vector3::Zero();                              ///< m
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< unit; always the identity for a sphere

  static RelativePose of(const Pose& body, const Pose& partner);
};

void set_warm_start(bool on) noexcept;

/// Copies the remembered unit normal of the pair and returns true; false when there is none, when warm start is off, or when the
/// pair has moved too far since: by more than half of `size` (the smallest half-extent of the two, m) or half a radian. A deep
/// overlap has several local maxima, and the solver stays on the one that a first normal leads to. That is continuity when the
/// pair has just been there, and an arbitrary depth when a body was moved by the program, or another sphere is in the old one's
/// place.
bool recall_normal(const PairKey& key, const RelativePose& pose, double size, Vector3& normal) noexcept;

/// Does nothing when warm start is off or there is no memory.
void remember_normal(const PairKey& key, const RelativePose& pose, const Vector3& normal) noexcept;

}  // namespace supernormal::ode
