// How much higher than the best known normal any other can be.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "proximity/bounds/barycentric_lp.hpp"
#include "proximity/bounds/linear_bounds.hpp"
#include "proximity/local/ascent.hpp"

namespace supernormal {

/// Bounds the largest value of s over the whole sphere, by branch and bound on spherical triangles of directions, and finds higher
/// normals on the way.
///
/// Every boundary point of the difference of the bodies bounds s from above everywhere, s(m) <= m.d: the same inner polytope that
/// EPA grows, but looked at from each direction, so that flat faces and coinciding points, on which the facets of a hull
/// degenerate, need no care. Over a triangle the least of a few such bounds has its maximum where a linear program says. Another
/// of the points known may be lower there; if none is, s is evaluated there, or the triangle is split. No triangle is given up
/// before its bound is low enough. A normal that turns out higher is climbed from.
///
/// Where a ball of radius rho rolls inside the difference of the bodies, the ball is taken out first: s + rho is the gap function
/// of what remains, d + rho n its boundary point, and its bounds hug s more tightly.
class BranchAndBound {
 public:
  /// Keeps references. `ascent` is the one that climbs from higher normals, and `cuts` has the points known so far.
  BranchAndBound(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const Settings& settings, double tolerance);
  ~BranchAndBound();
  BranchAndBound(const BranchAndBound&) = delete;
  BranchAndBound& operator=(const BranchAndBound&) = delete;

  /// What a search is to achieve.
  struct Goal {
    double share;         ///< it ends when no depth is proved to be less than the best by more than this share of it,
    int max_evaluations;  ///< or when the query has taken so many, the climbs at the end apart
    double cutoff;        ///< m; a normal that is higher than the best by more than this is climbed from
    double near;          ///< m; in the end those are, too, that are lower by less and lead up other hills; none if 0
  };

  /// Searches for higher normals than `best`. Whether the width was reached; `best`, `error` and `status` are those of the last
  /// climb that got higher.
  bool run(const Goal& goal, GapJet& best, double& error, Status& status);

  /// m; no normal is higher than the best by more.
  double excess() const { return excess_; }

 private:
  using Index = LinearBounds::Index;
  static constexpr Index kCorners = 3;

  /// A triangle of directions.
  struct Cell {
    std::array<Vector3, kCorners> corner;              // unit
    std::array<Index, BarycentricLp::kMaxCuts> cut{};  // those in the program
    BarycentricLp program;
    double bound;    // m; s + rho is not larger in this triangle
    Vector3 peak;    // where the program has its maximum, not normalised
    Index seen = 0;  // of so many cuts it is known that they do not lower the bound there
  };
  static constexpr Index kMaxTops = 6;
  /// Kept from query to query: nothing is allocated any more when it has grown large enough.
  struct Storage {
    LinearBounds cuts;        // s(m) + rho of every unit normal m is not above any; m
    std::vector<Cell> cells;  // a heap, the highest bound first
  };
  static Storage& kept_storage();
  static bool is_lower(const Cell& a, const Cell& b) { return a.bound < b.bound; }

  void start();
  Cell cell_of(const std::array<Vector3, kCorners>& corner, double bound) const;
  Index evaluate(const Vector3& direction);
  void climb_from(const Vector3& normal);
  void remember_top(const LocalCandidate& top);
  void climb_from_tops();
  void add_cut(Cell& cell, Index cut) const;
  void tighten(Cell& cell) const;
  void refine(Cell cell);
  void split(const Cell& cell);
  void keep(const Cell& cell);
  Cell pop();
  double excess_of(double bound) const { return bound - (best_.s + rho_); }
  double width() const { return std::max(-goal_.share * best_.s, tolerance_); }

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  Ascent& ascent_;
  const Settings& settings_;
  const double rho_, tolerance_;  // m
  Storage storage_;
  Goal goal_{};
  double excess_ = 0;                          // m
  double given_up_ = 0;                        // m; the highest bound of the triangles that were
  std::array<LocalCandidate, kMaxTops> tops_;  // the highest that were not climbed from, the lowest first
  Index top_count_ = 0;
  GapJet best_, jet_;
  double error_ = 0;  // m; of the climb to the best
  Status status_ = Status::Converged;
};

}  // namespace supernormal
