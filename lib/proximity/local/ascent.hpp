// Finds one local maximum of the gap function.
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

/// An evaluated normal that may be in another basin of attraction.
struct LocalCandidate {
  Vector3 n = Vector3::UnitX();
  double s = -std::numeric_limits<double>::infinity();  ///< m
};

/// Ascends s on the unit sphere from a given normal: propose, evaluate, add the cut. It stops when bounds prove the maximum or,
/// deep in an overlap, when the model estimates that it is reached (lib/proximity/README.md has the lemmas).
///
/// If the bodies may be apart, or overlap by less than the rolling ball, s + rho is concave where it matters, and a bound decides:
/// the nearest point p of the hull of all cuts has s + rho <= |p|. The step is the model's. If cuts exclude this step, or if the
/// model has converged and the bound has not, the step goes to the normal p / |p|. So this part is GJK with the steps of Newton's
/// method in it.
///
/// If the hull contains the origin, the bodies overlap by more than rho. No bound is local then. The estimate that ends the ascent
/// is the model's gain times a safety factor. If cuts exclude a step, the step goes to the maximum of the cuts.
class Ascent {
 public:
  /// Keeps references. Uses cuts of earlier ascents of the same pair, and adds new ones. `tolerance` in m. For an overlap of at
  /// most `unsearched_depth` (m), a point of both bodies may serve as proof of the overlap. For a deeper overlap the search for
  /// other maxima needs the hull.
  Ascent(GapFunction& gap, CuttingPlanes& cuts, const Settings& settings, double tolerance, double unsearched_depth);

  /// Climbs from the unit normal `start` and returns how the climb ended. The result is in best() and error(). Gives up, as
  /// Stalled, if the climb cannot get higher than `cutoff` (m).
  Status climb(const Vector3& start, double cutoff = -std::numeric_limits<double>::infinity());

  /// The same from a normal that has been evaluated with Hessians and whose cut is known. Not for bodies with nonsmooth points.
  Status climb(const GapJet& start);

  /// The highest normal of the last climb, with its Hessians.
  const GapJet& best() const { return current(); }

  /// If body 2 has nonsmooth points: the exact normal of the face or edge at best() (VertexCache::exact_normal).
  const Vector3& exact_normal() const { return exact_normals_[now_]; }

  /// m; what is left to the maximum. It is proved where s + rho is concave, and an estimate for the local maximum elsewhere.
  double error() const { return error_; }

  /// The highest normal from the hull that the climb did not move to.
  const LocalCandidate& candidate() const { return candidate_; }

 private:
  const GapJet& current() const { return jets_[now_]; }
  GapJet& current() { return jets_[now_]; }
  const GapJet& trial() const { return jets_[1 - now_]; }
  GapJet& trial() { return jets_[1 - now_]; }
  void restart();
  Status continue_climb(double cutoff);
  bool is_finished(double cutoff, Status& status) const;

  /// Whether s + rho is concave on the relevant cone of normals, touching included.
  bool is_concave() const { return height() >= -0.5 * tolerance_; }
  /// m; s + rho
  double height() const { return current().s + rolling_radius_; }

  Step choose_step();
  void move_to_exact_normal();
  bool have_common_point() const;
  void ask_hull(bool must_replace, Step& step);
  void take_top_of_cuts(Step& step);
  void keep_own_cut();
  bool is_ruled_out(const Step& step) const;
  bool is_level_but_flatter(double actual_gain) const;
  /// Evaluates into jets_[place].
  void evaluate(const Vector3& normal, std::size_t place);
  void learn_hessian();
  void adapt_radius(const Step& step, double actual_gain);

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  const Settings& settings_;
  const double tolerance_;         // m
  const double unsearched_depth_;  // m
  const double rolling_radius_;    // m; rho, of the Minkowski difference
  const bool has_kinks_;
  MinimumNormSearch hull_;  // of all cuts
  VertexCache vertices_;
  BfgsHessian bfgs_;
  ModelStep model_;
  std::array<GapJet, 2> jets_;            // the current and the trial, which change places
  std::array<ActiveVertices, 2> active_;  // of jets_
  std::array<Vector3, 2> exact_normals_;  // of jets_
  std::size_t now_ = 0;
  bool is_overlap_proved_ = false;
  LocalCandidate candidate_;
  // Of one climb:
  double radius_ = 0;                       // of the trust region, gnomonic
  double upper_ = 0;                        // m; the hull's bound on s + rho when it last proposed a normal
  Vector3 hulls_normal_ = Vector3::Zero();  // the normal of this proposal
  bool is_hull_next_ = false;
  bool is_from_hull_ = false;    // whether the step is the hull's
  bool is_from_bounds_ = false;  // whether the current normal is from the bounds
  bool is_model_short_ = false;  // whether the last step gained more than the model predicted
  bool is_stuck_ = false;        // whether neither model nor bounds propose a new normal
  double error_ = 0;             // m
};

}  // namespace supernormal
