// The maximum of the gap function where it can be proved with one bound.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "proximity/bounds/cutting_planes.hpp"
#include "proximity/contact_point.hpp"
#include "proximity/local/regular_hessian.hpp"
#include "proximity/solvers.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"

namespace supernormal {

/// Newton's method on the unit sphere, which stops when one inequality proves its answer.
///
/// Theorem. Let a ball of radius rho roll inside the difference of two bodies (rho >= 0; GapFunction::rolling_radius), and let
/// d = d(n) be the difference of their boundary points at a unit normal n with s(n) + rho > 0. Then
///     s(n) <= max s <= |d + rho n| - rho,
/// and the two sides differ by |d_t|^2 / (2 (s + rho)) to leading order, d_t being the part of d across n.
/// Proof. The difference of the bodies without the ball is convex and has the gap function s + rho and the boundary point
/// d + rho n, so that s(m) + rho <= m.(d + rho n) <= |d + rho n| for every unit m; and |d + rho n|^2 = (s + rho)^2 + |d_t|^2.
///
/// Hence the loop: propose a normal, evaluate, stop when the two sides are within the tolerance. Where s + rho > 0 the Hessian
/// M = H1 + H2 + s I (Roemer, Algorithm I) is positive definite across n, so that Newton's step M^-1 d_t leads up, and near the
/// maximum it squares d_t: the bound closes with it. No proposal needs to be good for the answer to be right. Where none gets
/// higher, on flat faces, the nearest point p of the hull of several such d + rho n takes the place of one: max s <= |p| - rho.
/// Where that is not enough, or the overlap is deeper than rho, or a handful of evaluations is spent, the loop ends without an
/// answer: the best normal and the cuts are what a more careful search starts from.
class CertifiedNewton {
 public:
  /// Whether the method is for this pair: Hessians and no kinks.
  static bool is_for(const GapFunction& gap) { return gap.has_hessian() && !gap.shape2().has_kinks(); }

  /// Keeps references; puts the difference of every evaluation into `cuts`. `tolerance`: m
  CertifiedNewton(GapFunction& gap, CuttingPlanes& cuts, const Settings& settings, double tolerance);

  enum class End {
    Proved,  ///< best() is the maximum, to the tolerance
    Apart,   ///< best() proves separation, which is all that was asked for
    Open,    ///< nothing is proved, and best() need not be finite
  };
  /// From the unit normal `start`. Deeper than rho there may be several maxima, and Newton's steps may lead to any: it makes none
  /// there where the branch of the start is wanted.
  End run(const Vector3& start, Branch branch);

  /// The highest normal evaluated, with its Hessians.
  const GapJet& best() const { return jets_[best_]; }

  /// m; after Proved, what is left to the maximum at most.
  double error() const { return error_; }

  /// The witness pairs of normals beside the highest, at which s is as high to within the tolerance: where the bodies are flat.
  std::span<const WitnessPair> beside() const { return {beside_.data(), beside_count_}; }

 private:
  // Two tilts find the other sides of the line where a triangle meets it; one more mends what rounding leaves.
  static constexpr int kMostTilts = 3;

  GapJet& next() { return jets_[1 - best_]; }
  bool is_within_reach() const { return best().s + rolling_radius_ > 0; }
  bool is_proved();
  /// Evaluates; whether that gave numbers.
  bool evaluate(const Vector3& n);
  /// A step across the best normal, gnomonic, that leads up; false if there is none to be trusted.
  bool propose(Vector3& step) const;
  bool parametrizations_agree(const Vector3& step) const;
  bool through_boundary_points(const RegularHessian& hessian, const Matrix3& H2, Vector3& step) const;
  /// Evaluates at the end of the step, or of a shorter one, until the normal there is higher than the best, and takes its place.
  bool climb(Vector3 step);
  /// Whether the best normal is proved by the hull of what was evaluated and a few normals beside it.
  bool prove_by_tilts();

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  const Settings& settings_;
  const double tolerance_;       // m
  const double rolling_radius_;  // m; of the difference of the bodies
  const bool has_flat_faces_;
  std::array<GapJet, 2> jets_;  // the best and the next, which change places
  std::size_t best_ = 0;
  double error_ = std::numeric_limits<double>::infinity();  // m
  std::array<WitnessPair, kMostTilts> beside_;
  std::size_t beside_count_ = 0;
};

}  // namespace supernormal
