// One local maximum of the gap function.
#pragma once

#include <array>
#include <limits>

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/local/bfgs_hessian.hpp"
#include "proximity/local/local_model.hpp"
#include "proximity/local/remaining_gain_estimate.hpp"
#include "proximity/local/vertex_cache.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// Ascends s on the unit sphere from a given normal. Each step
///   1. takes the Newton step within a trust region, from the Hessians of the shapes or a secant estimate of their sum;
///   2. where a body is flat, replaces it by the step that puts the flat body's boundary point opposite the other's: there the
///      normal is a smooth function of the boundary point, not the other way round;
///   3. where the boundary points found so far rule that step out (CuttingPlanes), replaces it by the maximum of the cuts;
///   4. where body 2 has faces or straight edges, takes the maximum over all of its corners for step 1, and goes to the exact
///   normal
///      of the edge or face where that lies;
///   5. evaluates, keeps the better normal, and adapts the trust radius to how much of the promised gain came true.
/// It has converged when the gain still to come, estimated from the model and its contraction, is within the tolerance.
class Ascent {
 public:
  /// Keeps references. Cuts of earlier ascents of the same pair are used and new ones are added.
  Ascent(GapFunction& gap, CuttingPlanes& cuts, const Settings& settings, double tolerance);

  /// Climbs from the unit normal `start`; how it ended. The result is in best() and error(). Gives up, as Stalled, a climb that
  /// will not get higher than `cutoff` (m).
  Status climb(const Vector3& start, double cutoff = -std::numeric_limits<double>::infinity());

  /// The same from a normal that has been evaluated, with curvature, and whose cut is known; not for bodies with kinks.
  Status climb(const GapJet& start);

  /// The highest normal of the last climb, with its curvature() in the tangent plane.
  const GapJet& best() const { return current(); }

  /// m; bound on what is left to the local maximum.
  double error() const { return error_; }

 private:
  struct Step {
    Vector3 normal;  ///< to evaluate next, not normalised
    double length;   ///< in gnomonic coordinates
    double gain;     ///< m; promised
  };
  /// What body 2 looks like from the current normal to first order: its boundary point, or a mean of those that share a normal.
  struct Target {
    double value;                      ///< m; s there is at most s + value + slope.u, but for the curvature of body 1
    Vector2 slope;                     ///< m
    Vector2 newton;                    ///< where the model has its maximum
    const PiecewiseModel::Peak* peak;  ///< null for a smooth body 2
    std::span<const Piece> pieces;     ///< of which the peak tells; none for a smooth body 2
  };

  const GapJet& current() const { return jets_[now_]; }
  GapJet& current() { return jets_[now_]; }
  const GapJet& trial() const { return jets_[1 - now_]; }
  GapJet& trial() { return jets_[1 - now_]; }
  Status climb_on(double cutoff);
  /// The next step is as good as the first of a climb.
  void forget_steps();
  LocalModel local_model(const GapJet& jet) const;
  Step choose_step();
  Step smooth_step(const LocalModel& local);
  Step kinked_step(const LocalModel& local);
  /// Whether the curvature here is known, and does not end nearby.
  bool curvature_holds() const;
  /// m; what s may gain by a turn of which no slope tells, as far as this (radians).
  double turn_gain(double reach) const;
  /// Radians; how far the normal may turn for nothing that has been seen to hold it.
  double unverified_angle(const LocalModel& local) const;
  double unverified_gain(const LocalModel& local, const Vector2& slope, bool is_held_by_curvature);
  enum class FlatStep {
    Taken,
    None,        ///< the bodies' proposals do not agree on one
    LeavesFace,  ///< it turns the normal by a right angle or more
  };
  FlatStep flat_step(const LocalModel& local, const Target& target, Step& step);
  bool parametrizations_agree(const LocalModel& local, const Vector2& newton) const;
  /// Goes on from beside the normal of a flat spot that does not hold it; false if there is none.
  bool leave_flat_spot();
  bool rises_beyond(const LocalModel& local, const Vector2& u);
  /// Tries a direction that no cut rules out.
  bool can_rise(const Vector3& direction);
  /// Than the current one, beyond rounding.
  bool is_higher(double s) const;
  void leave_face(const LocalModel& local, Step& step);
  void cut_step(const LocalModel& local, Step& step);
  double turn_to_come(const LocalModel& local) const;
  /// Of bodies that overlap, gnomonic: a normal that is turned so far gains about the tolerance, if nothing holds it.
  double tolerance_radius() const;
  void probe_step(const LocalModel& local, const CuttingPlanes::Maximum& top, double error, Step& step);
  bool ruled_out(const Step& step) const;
  /// Near the maximum s is level to rounding while its slope still tells the way.
  bool is_level_but_flatter(double actual_gain) const;
  void evaluate(const Vector3& normal, GapJet& jet, ActiveVertices& corners);
  void learn_curvature();
  void adapt_radius(const Step& step, double actual_gain);
  bool finished(double cutoff, Status& status) const;

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  const Settings& settings_;
  const double tolerance_;       // m
  const double rolling_radius_;  // m; of the difference of the bodies
  const bool has_flat_faces_;
  const bool may_be_tilted_;  // the flat faces
  const bool has_kinks_;
  BfgsHessian secant_;
  VertexCache known_;
  RemainingGainEstimate to_come_;
  std::array<GapJet, 2> jets_;             // current and trial, which change places
  std::array<ActiveVertices, 2> corners_;  // theirs
  std::size_t now_ = 0;
  double radius_ = 0;                    // of the trust region, gnomonic
  double flat_length_ = 0;               // of the last step through the boundary point, gnomonic; infinite before
  bool use_cutting_plane_step_ = false;  // whether the steps zigzag, and those to the maximum of the cuts have not led up yet
  bool is_open_ = false;                 // whether nothing is left but what a turn may gain that has not been seen
  double error_ = 0;                     // m
};

}  // namespace supernormal
