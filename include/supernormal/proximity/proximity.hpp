// Settings and result of a proximity query of two bodies.
#pragma once

#include <Eigen/Core>
#include <limits>

namespace supernormal {

/// The methods that find the common normal (lib/proximity/README.md).
enum class Solver {
  Hybrid,      ///< globally convergent ascent of the gap function; the default
  Newton,      ///< Algorithm I of Roemer's paper: analytic radii of curvature, no safeguard; Hybrid for shapes without a Hessian
  FixedPoint,  ///< Algorithm II of Roemer's paper: centres of curvature from secants, no derivatives, no safeguard
};

/// How a query ended.
enum class Status {
  Converged,        ///< the error is within the tolerance
  Apart,            ///< stopped early, as asked: the bodies are separated by `gap` or more
  Stalled,          ///< no further ascent in double precision, although the error exceeds the tolerance
  EvaluationLimit,  ///< Settings::max_evaluations reached
  Diverged,         ///< an unguarded solver (Newton, fixed point) left its domain: singular system or coincident centres
  InvalidInput,     ///< a pose or a shape gave a number that is not finite, or a matrix is no rotation; the result holds no answer
};

/// When a solver stops. `tolerance` is relative to the smallest half-extent of the two bodies. A solver has converged if
///     error <= tolerance * min(smallest half-extent of body 1, of body 2).
/// If one body is a point, only the other body counts. The limit is at least a few units of rounding of the terms of s.
struct Settings {
  Solver solver = Solver::Hybrid;  ///< the method that finds the common normal
  double tolerance = 1e-9;         ///< in [1e-15, 1]
  int max_evaluations = 1000;      ///< in [1, 1000000]
  bool stop_when_apart = false;    ///< end with Status::Apart at the first normal that proves separation
  /// Continue the search until the depth of overlapping bodies is proved the smallest: Proximity::is_global.
  bool certify_depth = false;

  bool operator==(const Settings&) const = default;  ///< whether both ask for the same
};

/// The common normal of two bodies. Points and the normal are in the frame of the query.
struct Proximity {
  double gap = 0;    ///< m; distance if positive, minus the penetration depth if negative
  double error = 0;  ///< m; estimate of what is left to the local maximum of the gap function: a bound if is_global, otherwise at
                     ///< least the tolerance
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< unit, from body 1 to body 2
  Eigen::Vector3d point1 = Eigen::Vector3d::Zero();   ///< m; on the boundary of body 1
  Eigen::Vector3d point2 = Eigen::Vector3d::Zero();   ///< m; on the boundary of body 2
  /// m; where a contact force acts: halfway between the tangent planes or, if that is outside a body, the nearest point of the
  /// overlap. To 1e-6 of the smallest half-extent it is in both bodies, or in the gap between them, if the query has converged,
  /// the tolerance is at most 1e-6 and `evaluations` is below Settings::max_evaluations. The status is that of the gap: the search
  /// for this point may end at the limit, and the point may then be outside of a body. It need not be between the two points above,
  /// which may be any points of a flat face.
  Eigen::Vector3d contact = Eigen::Vector3d::Zero();
  int evaluations = 0;                   ///< of the gap function, including those for the contact; 0 for two balls
  Status status = Status::InvalidInput;  ///< how the query ended
  /// Whether it is proved that no other normal has a larger gap. `gap` is then the largest value of the gap function, to within the
  /// larger of `error` and the tolerance. For overlapping bodies `-gap` is then the minimum translation distance (MTD), the length
  /// of the shortest translation that separates them. Always true for bodies apart or touching (overlapping by at most half of the
  /// tolerance), for closed forms (a plane), and after Settings::certify_depth unless the evaluations ran out. Otherwise true if
  /// the depth is at most the sum of the proved rolling radii of both bodies (Shape::rolling_radius).
  bool is_global = false;
  /// m; a proved bound: the largest value of the gap function is in [gap, gap + global_error]. If is_global, it is the larger of
  /// `error` and the tolerance; for a closed form (a plane, two balls) it is rounding alone. If the hybrid has searched for other
  /// maxima, it is 0.3 % of the depth (more if a shallow overlap ended the search), or a sixth of the depth if the hybrid followed
  /// an earlier normal. It is infinite for contacts with meshes, where only a part of the surface counts.
  double global_error = std::numeric_limits<double>::infinity();
};

}  // namespace supernormal
