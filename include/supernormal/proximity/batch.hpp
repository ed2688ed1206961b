// Proximity queries of many pairs at once.
#pragma once

#include <span>

#include "supernormal/proximity/pose.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// The arguments of find_proximity() for one pair, by reference.
struct ProximityQuery {
  const Shape* shape1;                    ///< body 1
  const Pose* pose1;                      ///< of body 1
  const Shape* shape2;                    ///< body 2
  const Pose* pose2;                      ///< of body 2
  const Vector3* first_normal = nullptr;  ///< unit, in body 1's frame, or null
  bool poses_are_usable = false;          ///< whether the caller has tested both poses (Pose), so that no query tests them
};

/// The same as find_proximity() with these arguments.
SUPERNORMAL_API Proximity find_proximity(const ProximityQuery& query, const Settings& settings = {});

/// The answers of find_proximity() for many pairs, bit for bit the same: results[k] is the answer of queries[k]. Pairs of
/// ellipsoids and superellipsoids are solved two, four or eight at a time, in the vector registers that the processor has. The
/// order of the pairs and their number do not change the digits. Uses one thread, some 90 kB of its stack, and for deep overlaps
/// the scratch memory that each thread keeps. Divide the pairs among threads as you like. No pointer but first_normal may be null.
///
/// Throws std::invalid_argument if the settings are out of range, or if `results` has another length than `queries`.
SUPERNORMAL_API void find_proximities(std::span<const ProximityQuery> queries, const Settings& settings,
                                      std::span<Proximity> results);

}  // namespace supernormal
