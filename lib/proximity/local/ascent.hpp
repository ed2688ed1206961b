// One local maximum of the gap function.
#pragma once

#include <array>
#include <limits>

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/bounds/minimum_norm_point.hpp"
#include "proximity/local/bfgs_hessian.hpp"
#include "proximity/local/model_step.hpp"
#include "proximity/local/vertex_cache.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// An evaluated normal that may lead up another hill.
struct LocalCandidate {
  Vector3 n = Vector3::UnitX();
  double s = -std::numeric_limits<double>::infinity();  ///< m
};

/// Ascends s on the unit sphere from a given normal: propose, evaluate, add the cut, and stop when bounds or, deep in an overlap,
/// the model say so (lib/proximity/README.md has the lemmas).
///
/// While the bodies may be apart, or are within the ball that rolls inside them, s + rho is concave where it matters and a bound
/// decides: the nearest point p of the hull of all cuts has s + rho <= |p|. The step is the model's; where cuts rule that out, or
/// where the model sees nothing more to gain and the bound is still open, the normal p / |p| takes its turn: so this part is GJK
/// with the steps of Newton's method in it.
///
/// Once the hull holds the origin the bodies overlap by more than rho. Then no bound is local: the model's gain, times a safety
/// factor, is the estimate that ends the ascent, and where cuts rule a step out, the highest point of the cuts is tried.
class Ascent {
 public:
  /// Keeps references. Cuts of earlier ascents of the same pair are used and new ones are added. `tolerance`: m. An overlap of up
  /// to `unsearched_depth` (m) may be proved by a point of both bodies; a search for other maxima has use for the hull that proves
  /// a deeper one.
  Ascent(GapFunction& gap, CuttingPlanes& cuts, const Settings& settings, double tolerance, double unsearched_depth);

  /// Climbs from the unit normal `start`; how it ended. The result is in best() and error(). Gives up, as Stalled, a climb that
  /// will not get higher than `cutoff` (m).
  Status climb(const Vector3& start, double cutoff = -std::numeric_limits<double>::infinity());

  /// The same from a normal that has been evaluated, with Hessians, and whose cut is known; not for bodies with kinks.
  Status climb(const GapJet& start);

  /// The highest normal of the last climb, with its Hessians.
  const GapJet& best() const { return current(); }

  /// Where body 2 has kinks: the normal of the face or edge that holds that of best() (VertexCache::held_normal).
  const Vector3& held_normal() const { return held_[now_]; }

  /// m; what is left to the maximum: proved where s + rho is concave, an estimate for the local maximum elsewhere.
  double error() const { return error_; }

  /// The highest normal of the hull that was not taken.
  const LocalCandidate& candidate() const { return candidate_; }

 private:
  const GapJet& current() const { return jets_[now_]; }
  GapJet& current() { return jets_[now_]; }
  const GapJet& trial() const { return jets_[1 - now_]; }
  GapJet& trial() { return jets_[1 - now_]; }
  void restart();
  Status climb_on(double cutoff);
  bool is_finished(double cutoff, Status& status) const;

  /// Whether s + rho is concave on the cone of the normals that matter, touching included.
  bool is_concave() const { return height() >= -0.5 * tolerance_; }
  /// m; s + rho
  double height() const { return current().s + rolling_radius_; }

  Step choose_step();
  void go_to_stratum();
  bool have_common_point() const;
  void ask_hull(bool must_replace, Step& step);
  void take_top_of_cuts(Step& step);
  void keep_own_cut();
  bool is_ruled_out(const Step& step) const;
  bool is_level_but_flatter(double actual_gain) const;
  /// Into the current place or the other one.
  void evaluate(const Vector3& normal, std::size_t place);
  void learn_hessian();
  void adapt_radius(const Step& step, double actual_gain);

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  const Settings& settings_;
  const double tolerance_;         // m
  const double unsearched_depth_;  // m
  const double rolling_radius_;    // m; rho, of the difference of the bodies
  const bool has_kinks_;
  MinimumNormSearch hull_;  // of all cuts
  VertexCache vertices_;
  BfgsHessian bfgs_;
  ModelStep model_;
  std::array<GapJet, 2> jets_;            // current and trial, which change places
  std::array<ActiveVertices, 2> active_;  // theirs
  std::array<Vector3, 2> held_;           // theirs
  std::size_t now_ = 0;
  bool is_overlap_proved_ = false;
  LocalCandidate candidate_;
  // Of one climb:
  double radius_ = 0;                       // of the trust region, gnomonic
  double upper_ = 0;                        // m; what the hull allowed s + rho when it last proposed a normal
  Vector3 hulls_normal_ = Vector3::Zero();  // of that proposal
  bool is_hulls_turn_ = false;
  bool is_from_hull_ = false;    // the step
  bool is_from_bounds_ = false;  // the current normal
  bool is_model_short_ = false;  // the last step brought more than the model promised
  bool is_stuck_ = false;        // neither model nor bounds propose a normal that is new
  double error_ = 0;             // m
};

}  // namespace supernormal
