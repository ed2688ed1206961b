#include "ode/runtime/warm_start.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>

#include "base/thread_kept.hpp"
#include "supernormal/proximity/separation.hpp"

namespace supernormal::ode {
namespace {

// An entry has 64 bytes: one cache line.
struct Entry {
  PairKey key;
  CachedNormal cached;
};
static_assert(sizeof(Entry) == 64);

constexpr double kSimilarOffset = 0.5;                         // relative to the size of the bodies
constexpr int kOrientationUnit = 1 << 14;                      // units of CachedNormal::orientation in 1
constexpr double kLeastTrace = 1 + 2 * 0.8775825618903727162;  // 1 + 2 cos(0.5): the trace of a rotation by half a radian
constexpr unsigned kCellBits = 13;                             // bits of PairKey::collider that hold the direction

// The table is a set-associative cache. A pair has one set, which holds the four most recently used pairs, latest first. In a
// direct-mapped table, two pairs with a common slot would evict each other at every step. Measured on lattices of neighbours: the
// table keeps all 7560 near pairs of 1000 bodies, all 85 000 of 10 000, and 98 % of the 168 000 of 20 000. Of 98 000 random pairs
// of 20 000 bodies it keeps 93 %. It takes up to 16 MB for each thread that collides.
constexpr std::size_t kWays = 4;
constexpr std::size_t kSets = std::size_t{1} << 16;
using Set = std::array<Entry, kWays>;

struct Free {
  void operator()(Set* sets) const { std::free(sets); }
};

std::atomic<bool> enabled{true};
thread_local ThreadKept<std::unique_ptr<Set[], Free>> kept_table;  // initially zero, which matches no key

// The sets of a body are adjacent, and next to the sets of the bodies created before and after it. So a scene touches few pages of
// the table at a time. Adding a constant to all serial numbers permutes the sets and changes nothing else: a scene built twice in a
// process runs identically.
constexpr std::size_t kSetsPerBody = 20;
constexpr unsigned kSpreadBits = 6;  // the sets of the next three bodies are used, too: old bodies have more pairs
std::size_t set_index(const PairKey& key) {
  const std::uint32_t hash = key.collider * 0x9e3779b1U;  // odd; 2^32 / golden ratio
  return (key.body * kSetsPerBody + (hash >> (32U - kSpreadBits))) % kSets;
}

/// Rounds a number in [-2, 2) to the nearest unit of 2^-14. Adds a number whose ulp is this unit, and takes the last bits of the
/// sum. Any other number, infinity and NaN included, gives an arbitrary result.
std::int16_t to_units(double value) {
  constexpr double kLastPlaceIsUnit = 3 * 0x1p51 / kOrientationUnit;
  return static_cast<std::int16_t>(std::bit_cast<std::uint64_t>(value + kLastPlaceIsUnit));
}

using Orientation = std::array<std::int16_t, 9>;

Orientation in_units(const Matrix3& rotation) {
  Orientation orientation;
  for (std::size_t k = 0; k < orientation.size(); ++k) orientation[k] = to_units(rotation.data()[k]);
  return orientation;
}

/// Whether the angle t between two orientations is at most half a radian. The trace of R^T R' is 1 + 2 cos t. The orientation of an
/// unknown pair is zero, which is similar to none.
bool is_similar(const Orientation& a, const Orientation& b) {
  constexpr auto kLeast = static_cast<std::int32_t>(kLeastTrace * kOrientationUnit * kOrientationUnit);
  std::uint32_t trace = 0;  // at most 3 kOrientationUnit^2 for rotations; the core refuses other matrices
  for (std::size_t k = 0; k < a.size(); ++k) trace += static_cast<std::uint32_t>(a[k] * b[k]);
  return static_cast<std::int32_t>(trace) >= kLeast;
}

template <typename Number>
Vector3 vector_of(const std::array<Number, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

bool same(const PairKey& a, const PairKey& b) { return a.body == b.body && a.collider == b.collider; }

}  // namespace

PairKey PairKey::of_direction(std::uint32_t serial, const Vector3& direction, std::uint32_t kind) {
  constexpr double kCellsPerUnit = 8;  // cells are 7 degrees wide
  const double length = direction.norm();
  std::uint32_t cell = 0;
  if (std::isfinite(length) && length > 0) {
    for (int axis = 0; axis < 3; ++axis) {
      cell = 17 * cell + static_cast<std::uint32_t>(std::lround(kCellsPerUnit * (direction[axis] / length + 1)));
    }
  }
  static_assert(17 * 17 * 17 <= 1U << kCellBits);
  return {serial, 0x80000000U | (kind << kCellBits) | cell};
}

std::uint32_t collider_kind(int geom_class, std::initializer_list<double> lengths) {
  auto hash = static_cast<std::uint64_t>(geom_class);
  for (const double length : lengths) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(length)) * 0x9e3779b97f4a7c15U;  // odd; 2^64 / golden ratio
    hash ^= hash >> 32U;
  }
  return static_cast<std::uint32_t>(hash);
}

RelativePose RelativePose::of(const Pose& frame, const Pose& other) {
  RelativePose relative;
  const Matrix3 to_frame = frame.rotation.transpose();
  relative.offset.noalias() = to_frame * (other.position - frame.position);
  relative.rotation.noalias() = to_frame * other.rotation;
  return relative;
}

CachedNormal CachedNormal::of(const RelativePose& pose, const Vector3& normal, double gap) {
  CachedNormal cached;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cached.normal[axis] = normal[static_cast<int>(axis)];
    cached.offset[axis] = static_cast<float>(pose.offset[static_cast<int>(axis)]);
  }
  cached.orientation = in_units(pose.rotation);
  // A float with its lower half cleared is smaller by up to 2^-7. The conversion may have rounded up, by 2^-24.
  constexpr double kLargest = std::numeric_limits<float>::max();
  const auto rounded = static_cast<float>(std::clamp(gap * (1 - 0x1p-23), 0.0, kLargest));
  cached.gap = static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(rounded) >> 16U);
  return cached;
}

void set_warm_start(bool on) noexcept { enabled.store(on, std::memory_order_relaxed); }

CachedNormal reserve_entry(const PairKey& key) noexcept {
  if (!enabled.load(std::memory_order_relaxed)) return {};
  auto& table = *kept_table;
  if (!table) {
    table.reset(static_cast<Set*>(std::calloc(kSets, sizeof(Set))));
    if (!table) return {};
  }
  Set& set = table[set_index(key)];
  if (same(set.front().key, key)) return set.front().cached;  // the usual case
  const auto known = std::find_if(set.begin(), set.end(), [&](const Entry& entry) { return same(entry.key, key); });
  const Entry entry = known == set.end() ? Entry{key, {}} : *known;
  const auto last = known == set.end() ? known - 1 : known;  // the least recently used pair is evicted
  std::move_backward(set.begin(), last, last + 1);
  set.front() = entry;
  return entry.cached;
}

void prefetch_entry(const PairKey& key) noexcept {
  auto& table = *kept_table;
  if (table) __builtin_prefetch(&table[set_index(key)], 1);
}

bool find_cached_normal(const CachedNormal& cached, const RelativePose& pose, double size, Vector3& normal) noexcept {
  const Vector3 moved = pose.offset - vector_of(cached.offset);
  const bool found = moved.squaredNorm() <= kSimilarOffset * kSimilarOffset * size * size &&
                     is_similar(in_units(pose.rotation), cached.orientation);
  if (found) normal = vector_of(cached.normal);
  return found;
}

double cached_separation(const CachedNormal& cached, const RelativePose& pose, double radius_of_frame, double radius) noexcept {
  if (cached.gap == 0) return 0;
  const Vector3 normal = vector_of(cached.normal);
  Matrix3 rotation;
  for (std::size_t k = 0; k < cached.orientation.size(); ++k) rotation.data()[k] = cached.orientation[k] * (1.0 / kOrientationUnit);
  const Vector3 offset = vector_of(cached.offset);
  // What the numbers of the entry were rounded by: the offset by 2^-24 of its length, each entry of the rotation by half a unit,
  // which turns a unit vector by at most three such halves.
  const double rounded = offset.norm() * 0x1p-24 + radius * (1.5 / kOrientationUnit);
  const double gap = std::bit_cast<float>(static_cast<std::uint32_t>(cached.gap) << 16U);
  return least_gap_after({normal, gap - rounded, offset, rotation.transpose() * normal}, pose.offset,
                         pose.rotation.transpose() * normal, radius_of_frame, radius);
}

void fill_entry(const PairKey& key, const CachedNormal& cached) noexcept {
  auto& table = *kept_table;
  if (!table || !enabled.load(std::memory_order_relaxed)) return;
  for (Entry& entry : table[set_index(key)]) {
    if (!same(entry.key, key)) continue;
    entry.cached = cached;
    return;
  }
}

}  // namespace supernormal::ode
