// How much higher than the best known normal any other can be.
#pragma once

#include <algorithm>
#include <array>

#include "proximity/bounds/inner_polytope.hpp"
#include "proximity/local/ascent.hpp"

namespace supernormal {

/// Bounds the largest value of s over the whole sphere and finds higher normals on the way, by the expanding polytope algorithm:
/// the facet of the hull of the known boundary points that is nearest to the origin says how large s may still be, and at its
/// normal s is evaluated next. A normal that turns out higher is climbed from.
///
/// Where a ball of radius rho rolls inside the difference of the bodies, the ball is taken out first: s + rho is the gap function
/// of what remains, d + rho n its boundary point, and the hull fits it more tightly.
class ExpandingPolytope {
 public:
  /// Keeps references. `ascent` is the one that climbs from higher normals, and `cuts` has the points known so far.
  ExpandingPolytope(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const Settings& settings, double tolerance);
  ~ExpandingPolytope();
  ExpandingPolytope(const ExpandingPolytope&) = delete;
  ExpandingPolytope& operator=(const ExpandingPolytope&) = delete;

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
  static constexpr std::size_t kMaxTops = 6;
  static InnerPolytope& kept_polytope();

  bool enclose_origin();
  void expand();
  Vector3 evaluate(const Vector3& normal);
  void climb_if_higher();
  void climb_from(const Vector3& normal);
  void remember_top(const LocalCandidate& top);
  void climb_from_tops();
  bool may_go_on() const { return status_ != Status::InvalidInput && gap_.evaluations() < goal_.max_evaluations; }
  /// Without their balls the bodies are apart: a climb has shown it, and found the only maximum.
  bool is_apart() const { return best_.s + rho_ > 0; }
  double width() const { return std::max(-goal_.share * best_.s, tolerance_); }

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  Ascent& ascent_;
  const Settings& settings_;
  const double rho_, tolerance_;  // m
  InnerPolytope polytope_;        // of the points d + rho n
  bool is_enclosed_ = false;      // whether it has the origin inside; until then its points are of another query
  Goal goal_{};
  double excess_ = 0;                          // m
  std::array<LocalCandidate, kMaxTops> tops_;  // the highest normals that were not climbed from
  std::size_t top_count_ = 0;
  GapJet best_, jet_;
  double error_ = 0;  // m; of the climb to the best
  Status status_ = Status::Converged;
};

}  // namespace supernormal
