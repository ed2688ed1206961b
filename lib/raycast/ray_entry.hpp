// The search for the point where a line enters a body.
#pragma once

#include <array>
#include <limits>

#include "base/tangent_plane.hpp"
#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/gap/stopping_rule.hpp"
#include "proximity/local/bfgs_hessian.hpp"
#include "raycast/portal.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// The unit normal at which the line c + t v enters the ellipsoid with these half-extents. If the line misses the ellipsoid, a
/// plane with this normal separates them.
Vector3 first_entry_normal(const Vector3& half_extents, const Vector3& c, const Vector3& v);

/// Finds the entry of the line c + t v, with c = gap.offset(). Body 1 of the gap function is the body, body 2 is a point.
///
/// A supporting plane with a normal n against v (n.v < 0) meets the line at t(n) = (n.c - h(n)) / -n.v. The body lies behind all
/// these planes, so the line enters at the largest t(n). With n = w - v, w perpendicular to v, t(w) = (w - v).c - h(w - v) is
/// concave. So it has one maximum. If the line misses the body, it has none; then w.c > h(w) for some w. Each step takes one of two
/// normals:
///   1. The normal at which the line meets the osculating paraboloid of the best sample. Near the maximum this is the Newton
///      step of t(n). It does not slow down where the line only grazes the body.
///   2. The normal of the portal, or a direction that may separate body and line while a hit is not yet certain. It
///      is taken if the last paraboloid gained too little, or if the portal excludes its normal.
class EntrySearch {
 public:
  enum class Kind {
    Miss,    ///< the line misses the body
    Beyond,  ///< the line enters the body after `limit`, or misses it
    Found,
  };

  struct Result {
    Kind kind = Kind::Miss;
    Status status = Status::InvalidInput;
    double t = 0;                       ///< m
    double error = 0;                   ///< m; bound on the distance of c + t v from the boundary
    double t_error = 0;                 ///< m; estimate of the error of t
    Vector3 normal = Vector3::UnitX();  ///< unit, outward
  };

  /// Keeps references to its arguments.
  EntrySearch(GapFunction& gap, const Vector3& direction, const Settings& settings);

  Result run(const Vector3& first_normal, double limit);

 private:
  struct Sample {
    GapJet jet;
    double slope = 0;                                     // n.v; 0: a plane along the line
    double t = -std::numeric_limits<double>::infinity();  // m; where the plane meets the line
  };
  struct Step {
    Vector3 normal = Vector3::Zero();
    double length = std::numeric_limits<double>::infinity();  // rad; estimate of the angle
    double gain = std::numeric_limits<double>::infinity();    // m; estimate of the distance from the plane to the boundary
    bool is_usable = false;
    bool is_deep = false;  // the line enters the paraboloid by more than the error
  };

  void evaluate(const Vector3& normal);
  void evaluate_beside(const Vector3& normal);
  Step paraboloid_step() const;
  Vector3 distance_at(const Sample& sample) const;
  bool is_better(const Sample& sample) const;
  double expected_error(const Step& step) const;
  double boundary_error() const;
  bool has_settled(const Step& step);
  bool is_worth_it(const Vector3& normal) const;
  bool choose(const Step& step, Vector3& normal);
  bool choose_by_portal(Vector3& normal);
  bool choose_by_points(Vector3& normal);
  bool add_point(const Vector3& d);
  Result found(Status status) const;

  GapFunction& gap_;
  const Vector3 v_;
  const Settings& settings_;
  const StoppingRule rule_;
  Portal portal_;
  BfgsHessian secant_;
  std::array<Vector3, CuttingPlanes::kCapacity> points_;  // m; c - r of the last evaluations
  int point_count_ = 0;
  Sample best_;                                                // the sample with the largest t
  Sample beside_;                                              // the last plane along the line
  double nearest_ = -std::numeric_limits<double>::infinity();  // m; the largest s of a plane along the line
  Vector3 nearest_normal_ = Vector3::UnitX();
  bool has_best_ = false;
  bool is_beside_latest_ = false;
  bool misses_ = false;
  bool is_finite_ = true;
  bool is_deep_ = false;                                          // the line enters the paraboloid at best_ by more than the error
  bool was_tried_ = false;                                        // the step of the paraboloid at best_ was taken
  double model_error_ = std::numeric_limits<double>::infinity();  // m; expected_error() at best_
  double point_error_ = std::numeric_limits<double>::infinity();  // m; distance of best_ from the hull of the stored points
  double promised_gain_ = std::numeric_limits<double>::infinity();  // m; the gain of the last step, if the paraboloid made it
  int slow_steps_ = 0;                                              // steps that did not halve the sector of separating directions
  int idle_steps_ = 0;                                              // steps that changed neither best_ nor the portal
  int fruitless_steps_ = 0;
  int polishing_steps_ = 0;
  bool tries_edge_ = true;
};

}  // namespace supernormal
