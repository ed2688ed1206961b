// The warm-start table: the last normal of each pair, where the next query of the pair starts.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal::ode {

/// The key of a pair in the table. Addresses would change from run to run, and with them the evictions and the last digits of
/// results. The serial numbers of our geoms do not change.
struct PairKey {
  std::uint32_t body = 0;      ///< serial number of our body; 0: none
  std::uint32_t collider = 0;  ///< see the two functions below

  /// The key of two of our bodies, serial1 < serial2. The normal is in the frame of body 1.
  static PairKey of_bodies(std::uint32_t serial1, std::uint32_t serial2) { return {serial1, serial2 - serial1}; }

  /// The key of a collider without a serial number (a geom of ODE): the direction from one to the other, in the frame of the
  /// normal, of any length. `kind` distinguishes colliders in the same direction by their class and lengths.
  static PairKey of_direction(std::uint32_t serial, const Vector3& direction, std::uint32_t kind);
};

/// A hash of the class of a geom and its lengths (in any unit). It is the same in every run.
std::uint32_t collider_kind(int geom_class, std::initializer_list<double> lengths);

/// The pose of one body in the frame of the other. The normal is in the same frame.
struct RelativePose {
  Vector3 offset = Vector3::Zero();        ///< m
  Matrix3 rotation = Matrix3::Identity();  ///< always the identity for a sphere

  static RelativePose of(const Pose& frame, const Pose& other);
};

void set_warm_start(bool on) noexcept;

/// The cached data of a pair. All zeros for an unknown pair, which no pose is similar to.
struct CachedNormal {
  std::array<double, 3> normal{};
  std::array<float, 3> offset{};              ///< m
  std::array<std::int16_t, 9> orientation{};  ///< the entries of the rotation in units of 2^-14
  std::uint16_t gap = 0;                      ///< m; the upper half of a float, rounded towards zero; 0: no separation is known

  /// `gap`, m: a proved lower bound of s at the normal, or 0. A gap beyond the range of float is as good as its limit.
  static CachedNormal of(const RelativePose& pose, const Vector3& normal, double gap);
};

/// Looks up the pair in this thread's table and makes it the most recently used. Returns its data: zeros on a cache miss, or when
/// warm start is off or memory ran out. Evictions depend only on the order of these calls, not on when fill_entry() follows.
CachedNormal reserve_entry(const PairKey& key) noexcept;

/// Prefetches the memory that reserve_entry() will read.
void prefetch_entry(const PairKey& key) noexcept;

/// Copies the cached unit normal of the pair and returns true. Returns false when there is none, or when the pair has moved by more
/// than half of `size` (the smallest half-extent of our bodies, m) or half a radian. A deep overlap has several local maxima, and
/// the solver stays in the basin of attraction where it starts. After a small displacement this gives continuity. After a jump of a
/// body, or with another sphere in its place, it would give an arbitrary depth.
bool find_cached_normal(const CachedNormal& cached, const RelativePose& pose, double size, Vector3& normal) noexcept;

/// m; a lower bound of s at the cached normal in the new pose, positive if it still separates the bodies. 0 or less when it proves
/// nothing, or no separation is known. The radii are Shape::bounding_radius() of the body with the frame, and of the other.
double cached_separation(const CachedNormal& cached, const RelativePose& pose, double radius_of_frame, double radius) noexcept;

/// Fills the reserved entry. Does nothing when the pair was evicted in between or warm start is off.
void fill_entry(const PairKey& key, const CachedNormal& cached) noexcept;

}  // namespace supernormal::ode
