// One local maximum of the gap function.
#pragma once

#include <limits>

#include "solvers/curvature.hpp"
#include "solvers/cutting_planes.hpp"
#include "solvers/local_model.hpp"
#include "supernormal/solvers/gap_function.hpp"
#include "supernormal/solvers/proximity.hpp"

namespace supernormal {

/// Ascends s on the unit sphere from a given normal. Each step
///   1. takes the Newton step within a trust region, from the Hessians of the shapes or a secant estimate of their sum;
///   2. where a body is flat, replaces it by the step that puts the flat body's boundary point opposite the other's: there the
///      normal is a smooth function of the boundary point, not the other way round;
///   3. where the boundary points found so far rule that step out (CuttingPlanes), replaces it by the maximum of the cuts;
///   4. evaluates, keeps the better normal, and adapts the trust radius to how much of the promised gain came true.
/// It has converged when the gain still to come, estimated from the model and its contraction, is within the tolerance.
class Ascent {
 public:
  /// Keeps references. Cuts of earlier ascents of the same pair are used and new ones are added.
  Ascent(GapFunction& gap, CuttingPlanes& cuts, const Settings& settings, double tolerance);

  /// Climbs from the unit normal `start`; how it ended. The result is in best() and error(). Gives up, as Stalled, a climb that
  /// will not get higher than `worth` (m).
  Status climb(const Vector3& start, double worth = -std::numeric_limits<double>::infinity());

  /// The highest normal of the last climb, with its curvature() in the tangent plane.
  const GapJet& best() const { return current_; }

  /// m; bound on what is left to the local maximum.
  double error() const { return error_; }

 private:
  struct Step {
    Vector3 normal;  ///< to evaluate next, not normalised
    double length;   ///< in gnomonic coordinates
    double gain;     ///< m; promised
  };
  Step choose_step();
  void flat_step(const LocalModel& local, const Vector2& newton, Step& step);
  bool ruled_out(const Step& step) const;
  /// Near the maximum s is level to rounding while its slope still tells the way.
  bool is_level_but_flatter(double actual_gain) const;
  void evaluate(const Vector3& normal, GapJet& jet);
  void adapt_radius(const Step& step, double actual_gain);
  bool finished(double worth, Status& status) const;

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  const Settings& settings_;
  const double tolerance_;  // m
  const bool has_flat_faces_;
  SecantCurvature secant_;
  GapJet current_, trial_;
  double radius_ = 0;         // of the trust region, gnomonic
  double promised_gain_ = 0;  // m; of the quadratic model at the last accepted normal; 0: no history
  double error_ = 0;          // m
};

}  // namespace supernormal
