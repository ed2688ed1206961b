// Whether two bodies are farther apart than a distance, at the least cost.
#pragma once

#include <limits>
#include <span>

#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/pose.hpp"
#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// A proved lower bound of the gap.
struct Clearance {
  double lower_bound = -std::numeric_limits<double>::infinity();  ///< m; the gap is at least this; -infinity for invalid input
  Vector3 normal = Vector3::UnitX();  ///< unit, in body 1's frame; it gives the bound, and is the first normal of the next query
  int evaluations = 0;                ///< of the gap function
};

/// A lower bound of the gap from at most `max_evaluations` evaluations of the gap function, in [1, 3]. Each normal gives a bound,
/// so the query ends at the first normal whose bound is above `enough` (m). Bounding spheres come first and take no evaluation. The
/// first normal is `first_normal` (unit, body 1's frame), or, if it is null or has not unit length, the normal where the line
/// between the centres leaves an ellipsoid that resembles the Minkowski sum. Rounding is subtracted from the bound.
///
/// Throws std::invalid_argument if max_evaluations is out of range or `enough` is NaN. If a pose is not usable (Pose), or a value
/// of a shape is not finite, the bound is -infinity.
SUPERNORMAL_API Clearance find_clearance(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                         double enough = std::numeric_limits<double>::infinity(), int max_evaluations = 3,
                                         const Vector3* first_normal = nullptr);

/// Whether the gap of two bodies is larger than `distance` (m, finite; negative: whether they overlap by less). True is proved by a
/// normal. False is exact but for the tolerance 1e-9 of find_proximity(), which answers where three evaluations do not. For a
/// negative distance, false means that no such normal was found (Proximity::is_global).
///
/// `normal`, if not null, is the first normal, in body 1's frame, unless it is zero. It receives the best normal for the next
/// query. `evaluations`, if not null, receives the number of evaluations. Invalid input is not farther. Throws
/// std::invalid_argument if `distance` is not finite.
SUPERNORMAL_API bool is_farther_than(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2,
                                     double distance, Vector3* normal = nullptr, int* evaluations = nullptr);

/// The answers of is_farther_than() for many pairs: results[k] belongs to queries[k], and is_farther[k] says whether its lower
/// bound proves it. Returns how many are farther. Throws std::invalid_argument if the spans differ in length or `distance` is not
/// finite.
SUPERNORMAL_API std::size_t are_farther_than(std::span<const ProximityQuery> queries, double distance, std::span<Clearance> results,
                                             std::span<bool> is_farther);

}  // namespace supernormal
