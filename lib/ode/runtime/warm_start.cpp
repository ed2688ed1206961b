#include "ode/runtime/warm_start.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <memory>

namespace supernormal::ode {
namespace {

// An entry has 64 bytes: a line of the processor's cache.
struct Entry {
  PairKey key;
  Remembered remembered;
};
static_assert(sizeof(Entry) == 64);

constexpr double kSimilarOffset = 0.5;                         // relative to the size of the bodies
constexpr int kAttitudeUnit = 1 << 14;                         // the number of units of RelativePose::Attitude in 1
constexpr double kLeastTrace = 1 + 2 * 0.8775825618903727162;  // 1 + 2 cos(0.5): the trace of a rotation by half a radian
constexpr unsigned kCellBits = 13;                             // bits of PairKey::collider that hold the direction

// The table is a set-associative cache: a pair has one set, which holds the four last used pairs, latest first. Two pairs that
// share a slot of a direct-mapped table would push each other out at every step. Counts on lattices of neighbours: all of the
// 7560 near pairs of 1000 bodies and of the 85 000 of 10 000 are kept, 98 % of the 168 000 of 20 000; of 98 000 pairs of 20 000
// bodies at random, 93 %. It takes up to 16 MB for each thread that collides.
constexpr std::size_t kWays = 4;
constexpr std::size_t kSets = std::size_t{1} << 16;
using Set = std::array<Entry, kWays>;

struct Free {
  void operator()(Set* sets) const { std::free(sets); }
};

std::atomic<bool> enabled{true};
thread_local std::unique_ptr<Set[], Free> table;  // all zeros at first, which no key matches

// The sets of a body lie together, and beside those of the bodies that were made before and after it: a scene touches the part of
// the table that its bodies use, and few pages at a time. Adding a constant to all serial numbers renumbers the sets and changes
// nothing else, so that a scene built for the second time in a process runs as the first.
constexpr std::size_t kSetsPerBody = 20;
constexpr unsigned kSpreadBits = 6;  // over the sets of the next three bodies, too: old bodies have more pairs
std::size_t set_index(const PairKey& key) {
  const std::uint32_t hash = key.collider * 0x9e3779b1U;  // odd; 2^32 / golden ratio
  return (key.body * kSetsPerBody + (hash >> (32U - kSpreadBits))) % kSets;
}

/// Rounds a number within [-2, 2) to units of 2^-14, by taking the last bits of its sum with a number whose last place is this
/// unit. Any other number, infinities and NaN are allowed too, but give arbitrary results.
std::int16_t to_units(double value) {
  constexpr double kLastPlaceIsUnit = 3 * 0x1p51 / kAttitudeUnit;
  return static_cast<std::int16_t>(std::bit_cast<std::uint64_t>(value + kLastPlaceIsUnit));
}

/// Whether the angle between two attitudes is at most half a radian: the trace of R^T R' is 1 + 2 cos of that angle. Unknown pairs
/// have attitudes of zeros, which are similar to no attitude.
bool is_similar(const RelativePose::Attitude& a, const RelativePose::Attitude& b) {
  constexpr auto kLeast = static_cast<std::int32_t>(kLeastTrace * kAttitudeUnit * kAttitudeUnit);
  std::uint32_t trace = 0;  // within 3 kAttitudeUnit^2 for rotations; the core refuses other matrices
  for (std::size_t k = 0; k < a.size(); ++k) trace += static_cast<std::uint32_t>(a[k] * b[k]);
  return static_cast<std::int32_t>(trace) >= kLeast;
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
  const Matrix3 rotation = to_frame * other.rotation;
  for (std::size_t k = 0; k < relative.attitude.size(); ++k) relative.attitude[k] = to_units(rotation.data()[k]);
  return relative;
}

void set_warm_start(bool on) noexcept { enabled.store(on, std::memory_order_relaxed); }

Remembered reserve_entry(const PairKey& key) noexcept {
  if (!enabled.load(std::memory_order_relaxed)) return {};
  if (!table) {
    table.reset(static_cast<Set*>(std::calloc(kSets, sizeof(Set))));
    if (!table) return {};
  }
  Set& set = table[set_index(key)];
  if (same(set.front().key, key)) return set.front().remembered;  // this is nearly always so
  const auto known = std::find_if(set.begin(), set.end(), [&](const Entry& entry) { return same(entry.key, key); });
  const Entry entry = known == set.end() ? Entry{key, {}} : *known;
  const auto last = known == set.end() ? known - 1 : known;  // the oldest is dropped
  std::move_backward(set.begin(), last, last + 1);
  set.front() = entry;
  return entry.remembered;
}

void prefetch_entry(const PairKey& key) noexcept {
  if (table) __builtin_prefetch(&table[set_index(key)], 1);
}

bool recall_normal(const Remembered& remembered, const RelativePose& pose, double size, Vector3& normal) noexcept {
  const auto& [direction, offset, attitude] = remembered;
  const Vector3 moved = pose.offset - Vector3(offset[0], offset[1], offset[2]);
  const bool found = moved.squaredNorm() <= kSimilarOffset * kSimilarOffset * size * size && is_similar(pose.attitude, attitude);
  if (found) normal = Vector3(direction[0], direction[1], direction[2]);
  return found;
}

void fill_entry(const PairKey& key, const RelativePose& pose, const Vector3& normal) noexcept {
  if (!table || !enabled.load(std::memory_order_relaxed)) return;
  for (Entry& entry : table[set_index(key)]) {
    if (!same(entry.key, key)) continue;
    Remembered& remembered = entry.remembered;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      remembered.normal[axis] = normal[static_cast<int>(axis)];
      remembered.offset[axis] = static_cast<float>(pose.offset[static_cast<int>(axis)]);
    }
    remembered.attitude = pose.attitude;
    return;
  }
}

}  // namespace supernormal::ode
