// The search for the point where a line enters a body.
#pragma once

#include <array>
#include <limits>

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/local/bfgs_hessian.hpp"
#include "proximity/tangent_plane.hpp"
#include "raycast/portal.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// The normal at which the line c + t v enters the ellipsoid with these half-extents, or, when it misses it, the normal of the
/// plane between both, perpendicular to v.
Vector3 first_entry_normal(const Vector3& half_extents, const Vector3& c, const Vector3& v);

/// Finds the entry of the line c + t v, where c = gap.offset(): body 1 of the gap function is the body, body 2 a point.
///
/// A plane with normal n against v (n.v < 0) supports the body and meets the line at t(n) = (n.c - h(n)) / -n.v; in front of it
/// there is no body, so the line enters at the largest t(n). With n = w - v, w perpendicular to v, t(w) = (w - v).c - h(w - v) is
/// concave: it has one maximum, or, if the line passes the body, none, but a w with w.c > h(w). Each step
///   1. meets the line with the osculating paraboloid at the best normal so far and goes to the normal there (which is the Newton
///      step of t(n) near the maximum and does not slow down where the line only grazes the body), unless
///   2. the last such step did not bring it much nearer, or the Portal rules it out: then to the normal of the portal, or, as long
///      as it is not known whether the line hits the body, to a direction that may separate them.
class EntrySearch {
 public:
  enum class Kind {
    Miss,    ///< the line passes the body
    Beyond,  ///< it enters after `limit`, if at all
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

  /// Keeps references to its arguments. `tolerance` in m.
  EntrySearch(GapFunction& gap, const Vector3& direction, const Settings& settings, double tolerance);

  Result run(const Vector3& first_normal, double limit);

 private:
  struct Sample {
    GapJet jet;
    double slope = 0;                                     // n.v; 0: a plane along the line
    double t = -std::numeric_limits<double>::infinity();  // m; where the plane meets the line
  };
  struct Step {
    Vector3 normal = Vector3::Zero();
    double length = std::numeric_limits<double>::infinity();  // estimate of the angle, radians
    double gain = std::numeric_limits<double>::infinity();    // m; estimate of the distance from the plane to the boundary
    bool is_usable = false;
    bool is_deep = false;  // the line enters the paraboloid by more than an error
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
  const double tolerance_;  // m
  Portal portal_;
  BfgsHessian secant_;
  std::array<Vector3, CuttingPlanes::kCapacity> points_;  // c - r of the last evaluations
  int point_count_ = 0;
  Sample best_;                                                // the sample with the largest t
  Sample beside_;                                              // the last plane along the line
  double nearest_ = -std::numeric_limits<double>::infinity();  // m; the largest s of a plane along the line
  Vector3 nearest_normal_ = Vector3::UnitX();
  bool has_best_ = false;
  bool is_beside_latest_ = false;
  bool misses_ = false;
  bool is_finite_ = true;
  bool is_deep_ = false;                                            // the line enters the paraboloid at best_ by more than an error
  bool was_tried_ = false;                                          // the step of that paraboloid was taken
  double model_error_ = std::numeric_limits<double>::infinity();    // m; expected_error() at best_
  double point_error_ = std::numeric_limits<double>::infinity();    // m; distance of the remembered points' hull from best_
  double promised_gain_ = std::numeric_limits<double>::infinity();  // m; that of the last step, if it was one of the paraboloid
  int slow_steps_ = 0;                                              // steps that did not halve the sector of separating directions
  int idle_steps_ = 0;                                              // steps that changed neither best_ nor the portal
  int fruitless_steps_ = 0;
  int polishing_steps_ = 0;
  bool tries_edge_ = true;
};

}  // namespace supernormal
