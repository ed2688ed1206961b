// The maximum of the gap function, if one bound can prove it.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/gap/limits.hpp"
#include "proximity/gap/stopping_rule.hpp"
#include "proximity/local/regular_hessian.hpp"
#include "proximity/search/contact_point.hpp"
#include "proximity/search/solvers.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// Newton's method on the unit sphere. It stops when one inequality proves its answer.
///
/// Theorem. Let a ball of radius rho roll inside the Minkowski difference of two bodies (rho >= 0; GapFunction::rolling_radius).
/// Let d = d(n) be the vector between their boundary points at a unit normal n with s(n) + rho > 0. Then
///     s(n) <= max s <= |d + rho n| - rho,
/// and the two sides differ by |d_t|^2 / (2 (s + rho)) to leading order, where d_t is the part of d across n. Proof. The Minkowski
/// difference without the ball is convex. It has the gap function s + rho and the boundary point d + rho n. So s(m) + rho <= m.(d +
/// rho n) <= |d + rho n| for every unit m; and |d + rho n|^2 = (s + rho)^2 + |d_t|^2.
///
/// The loop proposes a normal, evaluates it, and stops when the two sides are within the tolerance. If s + rho > 0, the Hessian M =
/// H1 + H2 + s I (Roemer, Algorithm I) is positive definite across n. So Newton's step M^-1 d_t leads up, and near the maximum it
/// squares d_t, which closes the bound. The answer is right however good the proposals are. On flat faces no proposal may get
/// higher. Then the nearest point p of the hull of several d + rho n takes the place of one: max s <= |p| - rho. The loop ends
/// without an answer if this is not enough, if the overlap is deeper than rho, or after a few evaluations. A more careful search
/// then starts from the best normal and the cuts.
class CertifiedNewton {
 public:
  /// Whether the method applies to this pair: both shapes have Hessians, and body 2 has no nonsmooth points.
  static bool is_for(const GapFunction& gap) { return gap.has_hessian() && !gap.traits2().has_nonsmooth_points; }

  /// Keeps references. Adds the d of every evaluation to `cuts`.
  CertifiedNewton(GapFunction& gap, CuttingPlanes& cuts, const StoppingRule& rule);

  enum class End {
    Proved,  ///< best() is the maximum, to the tolerance
    Apart,   ///< best() proves separation, and the settings ask for no more
    Open,    ///< nothing is proved, and best() need not be finite
  };
  /// Searches from the unit normal `start`. Deeper than rho there may be several maxima, and Newton's steps may lead to any of
  /// them. So there it makes no step if a maximum is tracked.
  End run(const Vector3& start, WantedMaximum wanted);

  /// The highest evaluated normal, with its Hessians.
  const GapJet& best() const { return jets_[best_]; }

  /// m; after Proved: a bound on max s - best().s.
  double error() const { return error_; }

  /// The witness pairs of the tilted normals, at which s equals best().s to within the tolerance. Not empty only for flat bodies.
  std::span<const WitnessPair> beside() const { return {beside_.data(), beside_count_}; }

 private:
  GapJet& next() { return jets_[1 - best_]; }
  bool is_provable() const { return best().s + rolling_radius_ > 0; }
  bool is_proved();
  /// Evaluates at n, and returns whether the result is finite.
  bool evaluate(const Vector3& n, Order order = Order::Hessian);
  /// Proposes an ascending step across the best normal, in gnomonic coordinates. Returns false if there is no reliable step.
  bool propose(Vector3& step) const;
  bool parametrizations_agree(const Vector3& step) const;
  bool through_boundary_points(const RegularHessian& hessian, const Matrix3& H2, Vector3& step) const;
  /// Evaluates at the end of the step, or of shorter steps, until the normal there is higher than the best and becomes the best.
  bool climb(Vector3 step);
  /// Whether the hull of the evaluations and a few tilted normals proves the best normal.
  bool prove_by_tilts();

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  const StoppingRule& rule_;
  const double rolling_radius_;  // m; of the Minkowski difference
  const bool has_flat_faces_;
  std::array<GapJet, 2> jets_;  // the best and the next, which change places
  std::size_t best_ = 0;
  double error_ = std::numeric_limits<double>::infinity();  // m
  std::array<WitnessPair, limits::kMostTilts> beside_;
  std::size_t beside_count_ = 0;
};

}  // namespace supernormal
