// Queries of ellipsoids and superellipsoids by the kernels in lanes, and what they leave to the scalar search.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "proximity/lanes/pair_query.hpp"
#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/proximity/relative_curvature.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Whether a pair goes through the kernels: of ellipsoids and superellipsoids, with the hybrid solver.
bool is_for_lanes(const Shape& shape1, const Shape& shape2, const Settings& settings);

/// The answer of one pair for which is_for_lanes(). The poses are usable, and `first_normal` is too, or null.
Proximity find_in_one_lane(const ProximityQuery& pair, const Settings& settings);

/// find_proximities(), with `curvatures` as in LaneBatch. It is empty, or as long as `queries`.
void find_in_lanes(std::span<const ProximityQuery> queries, const Settings& settings, std::span<Proximity> results,
                   std::span<ContactCurvature> curvatures);

/// The same answers, to the bit, of many pairs. Ellipsoids take a kernel without powers, so there are two groups, and each is
/// solved as soon as it is full.
class LaneBatch {
 public:
  /// Keeps references. `kernel`: of lane_kernels(). The answer of a pair goes to results[index] and, unless `curvatures` is empty,
  /// its curvature to curvatures[index]. If the lanes do not know the curvature, both numbers are kUnknownCurvature.
  LaneBatch(const Settings& settings, const LaneKernel& kernel, std::span<Proximity> results,
            std::span<ContactCurvature> curvatures = {})
      : settings_(settings), kernel_(kernel), results_(results), curvatures_(curvatures) {}

  /// Adds a pair as for find_in_one_lane().
  void add(const ProximityQuery& query, std::size_t index);

  /// Solves the pairs that have not filled a group.
  void solve_rest();

 private:
  static constexpr std::size_t kAtOnce = 64;
  struct Group {
    std::array<LanePair, kAtOnce> pairs;
    std::array<ProximityQuery, kAtOnce> queries;
    std::array<std::size_t, kAtOnce> indices;
    std::size_t count = 0;
  };

  void solve(Group& group);

  const Settings& settings_;
  const LaneKernel& kernel_;
  std::span<Proximity> results_;
  std::span<ContactCurvature> curvatures_;
  std::array<Group, 2> groups_;  // of ellipsoids, of all others
};

}  // namespace supernormal
