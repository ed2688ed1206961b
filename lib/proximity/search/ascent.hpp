// Finds one local maximum of the gap function.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/bounds/minimum_norm_point.hpp"
#include "proximity/gap/stopping_rule.hpp"
#include "proximity/gap/tuning.hpp"
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
/// deep in an overlap, when the model estimates that it is reached. lib/proximity/theory.md has the lemmas.
///
/// If the bodies may be apart, or overlap by less than the rolling ball, s + rho is concave where it matters (lemma 3), and lemma 2
/// decides: the nearest point p of the hull of all cuts has s + rho <= |p|. The step is the model's. If cuts exclude this step, or
/// if the model has converged and the bound has not, the step goes to the normal p / |p|. So this part is GJK with the steps of
/// Newton's method in it.
///
/// If the hull contains the origin, the bodies overlap by more than rho. No bound is local then. The estimate that ends the ascent
/// is the model's gain times a safety factor. If cuts exclude a step, the step goes to the maximum of the cuts.
class Ascent {
 public:
  /// Keeps references. Uses cuts of earlier ascents of the same pair, and adds new ones. For an overlap of at most
  /// `unsearched_depth` (m), a point of both bodies may serve as proof of the overlap. For a deeper overlap the search for other
  /// maxima needs the hull.
  Ascent(GapFunction& gap, CuttingPlanes& cuts, const StoppingRule& rule, double unsearched_depth);

  /// Climbs from the unit normal `start` and returns how the climb ended. The result is in best() and error(). Gives up, as
  /// Stalled, if the climb cannot get higher than `cutoff` (m).
  Status climb(const Vector3& start, double cutoff = -std::numeric_limits<double>::infinity());

  /// The same from a normal that has been evaluated with Hessians and whose cut is known. Not for bodies with nonsmooth points.
  Status climb(const GapJet& start);

  /// The highest normal of the last climb, with its Hessians.
  const GapJet& best() const { return here().jet; }

  /// If body 2 has nonsmooth points: the exact normal of the face or edge at best() (VertexCache::exact_normal).
  const Vector3& exact_normal() const { return here().exact_normal; }

  /// m; what is left to the maximum. It is proved where s + rho is concave, and an estimate for the local maximum elsewhere.
  double error() const { return error_; }

  /// The highest normal from the hull that the climb did not move to.
  const LocalCandidate& candidate() const { return candidate_; }

 private:
  /// An evaluated normal.
  struct Point {
    GapJet jet;
    Vector3 cut;                 // m; its boundary point with the ball, as the cuts store it
    ActiveVertices active;       // of body 2
    Vector3 exact_normal;        // of the face or edge of body 2
    bool is_by_estimate = true;  // whether the step to it came with an estimate of what is left; a step of the bounds has none
  };

  enum class Proposer {
    Model,
    Hull,   // its nearest point
    Cuts,   // their highest point over the tangent plane
    Nobody  // neither model nor bounds propose a new normal
  };
  struct Proposal {
    Step step;
    Proposer proposer;
  };

  enum class Prediction {
    Good,
    TooLow  // the model misses something, and the bounds propose
  };

  /// What the steps of one climb leave to the next.
  struct Memory {
    double radius = kTuning.longest_step;                    // of the trust region, gnomonic
    Prediction prediction = Prediction::Good;                // of the last step that was not the hull's
    Proposer last_asked = Proposer::Model;                   // Model or Hull: they take turns when the model has converged
    double upper = std::numeric_limits<double>::infinity();  // m; the hull's bound on s + rho when it last proposed a normal
    Vector3 hulls_normal = Vector3::Zero();                  // the normal of this proposal
  };

  const Point& here() const { return points_[here_]; }
  Point& here() { return points_[here_]; }
  const Point& trial() const { return points_[1 - here_]; }
  Point& trial() { return points_[1 - here_]; }

  Status climb_on(double cutoff);
  std::optional<Status> end_of_climb(Proposer proposer, double cutoff) const;

  Proposal propose();
  Proposal propose_where_concave(const Step& models, bool is_converged, bool is_refused);
  Proposal propose_in_overlap(const Step& models, double estimate, bool is_refused);
  Proposal highest_of_cuts();
  Proposal nearest_of_hull(const MinimumNormPoint& nearest);
  bool is_ruled_out(const Step& step) const;
  bool have_common_point() const;

  void move_to_exact_normal();
  bool is_level_but_flatter(double actual_gain) const;
  void evaluate(const Vector3& normal, Point& point);
  Vector3 cut_of(const GapJet& jet) const { return jet.d + rolling_radius_ * jet.n; }
  void keep_own_cut();
  void learn_hessian();
  void learn_radius(const Step& step, double actual_gain);
  void shrink_radius(double length);

  /// m; s + rho
  double height() const { return here().jet.s + rolling_radius_; }
  /// Whether s + rho is concave on the relevant cone of normals (lemma 3), touching included.
  bool is_concave() const { return height() >= -0.5 * rule_.tolerance(); }

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  const StoppingRule& rule_;
  const double unsearched_depth_;  // m
  const double rolling_radius_;    // m; rho, of the Minkowski difference
  const bool has_nonsmooth_points_;
  MinimumNormSearch hull_;  // of all cuts
  VertexCache vertices_;
  BfgsHessian bfgs_;
  ModelStep model_;
  std::array<Point, 2> points_;  // the highest and the trial, which change places
  std::size_t here_ = 0;
  Memory memory_;
  double error_ = 0;  // m
  LocalCandidate candidate_;
  bool is_overlap_proved_ = false;
};

}  // namespace supernormal
