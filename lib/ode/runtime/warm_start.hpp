// The last normal of each pair, where the next query of the pair starts.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// The key of a pair in the table. Addresses would identify geoms too, but they change from run to run, and with them which
/// entries push out which: the same scene would give other last digits. Serial numbers of our geoms do not change.
struct PairKey {
  std::uint32_t body = 0;      ///< serial number of a body of ours; 0 is nobody
  std::uint32_t collider = 0;  ///< see the two functions below

  /// The key of two of our bodies, serial1 < serial2; the normal is in the frame of body 1.
  static PairKey of_bodies(std::uint32_t serial1, std::uint32_t serial2) { return {serial1, serial2 - serial1}; }

  /// The key of a collider without a serial number (ODE's own geoms): the direction in which one sees the other, in the frame
  /// that the normal is in, of any length. `kind` tells colliders apart that may be seen in the same direction, by their class
  /// and lengths.
  static PairKey of_direction(std::uint32_t serial, const Vector3& direction, std::uint32_t kind);
};

/// A number for the class of a geom and its lengths (in any unit): the same in every run.
std::uint32_t collider_kind(int geom_class, std::initializer_list<double> lengths);

/// The pose of one body in the frame of the other, which is also that of the normal.
struct RelativePose {
  /// The entries of a rotation in units of 2^-14: a comparison with half a radian needs no more digits.
  using Attitude = std::array<std::int16_t, 9>;

  Vector3 offset = Vector3::Zero();  ///< m
  Attitude attitude{};               ///< always the identity for a sphere

  static RelativePose of(const Pose& frame, const Pose& other);
};

void set_warm_start(bool on) noexcept;

/// The remembered data of a pair; all zeros for an unknown pair, to which no pose is similar.
struct Remembered {
  std::array<double, 3> normal{};
  std::array<float, 3> offset{};
  RelativePose::Attitude attitude{};
};

/// Keeps room for the pair in this thread's table, until others push it out, and returns its content; zeros when warm start is
/// off or there is no memory. Which pairs are pushed out depends on the order of these calls alone, and not on when the normals
/// are found and filled in.
Remembered reserve_entry(const PairKey& key) noexcept;

/// Makes the processor fetch what reserve_entry will read.
void prefetch_entry(const PairKey& key) noexcept;

/// Copies the remembered unit normal of the pair and returns true; false when there is none or when the pair has moved too far
/// since: by more than half of `size` (the smallest half-extent of our bodies, m) or half a radian. A deep overlap has several
/// local maxima, and the solver stays on the one that a first normal leads to. That is continuity when the pair has just been
/// there, and an arbitrary depth when a body was moved by the program, or another sphere is in the old one's place.
bool recall_normal(const Remembered& remembered, const RelativePose& pose, double size, Vector3& normal) noexcept;

/// Writes into the room that was kept; does nothing when the pair has been pushed out since or warm start is off.
void fill_entry(const PairKey& key, const RelativePose& pose, const Vector3& normal) noexcept;

}  // namespace supernormal::ode
