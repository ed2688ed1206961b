// How much higher than the best known normal any other normal can be.
#pragma once

#include <algorithm>
#include <array>

#include "proximity/bounds/inner_polytope.hpp"
#include "proximity/search/ascent.hpp"

namespace supernormal {

/// Bounds the largest value of s over the whole sphere, and finds higher normals, by the expanding polytope algorithm. The facet of
/// the hull of the known boundary points that is nearest to the origin bounds s. The next evaluation is at this facet's normal. If
/// it is higher, the ascent climbs from there.
///
/// If a ball of radius rho rolls inside the Minkowski difference, the ball is taken out first. The remaining body has the gap
/// function s + rho and the boundary points d + rho n, and the hull fits it more tightly.
class ExpandingPolytope {
 public:
  /// Keeps references. `ascent` climbs from higher normals. `cuts` contains the points known so far.
  ExpandingPolytope(GapFunction& gap, CuttingPlanes& cuts, Ascent& ascent, const StoppingRule& rule);
  ~ExpandingPolytope();
  ExpandingPolytope(const ExpandingPolytope&) = delete;
  ExpandingPolytope& operator=(const ExpandingPolytope&) = delete;

  /// When a search ends, and from where it climbs.
  struct SearchLimits {
    /// Relative to the best depth: the search ends when it is proved that no depth is smaller by more than this.
    double relative_width;
    int max_evaluations;  ///< the search also ends after this many evaluations of the query, without the final climbs
    double cutoff;        ///< m; the ascent climbs from a normal that is higher than the best by more than this
    /// m; in the end the ascent also climbs from normals that are lower by less than this, in other basins of attraction. 0: no
    /// such climbs.
    double near;
  };

  /// Searches for higher normals than `best`. Returns whether the depth is proved within width(). `best`, `error` and `status` are
  /// from the last climb that got higher.
  bool run(const SearchLimits& limits, GapJet& best, double& error, Status& status);

  /// m; no normal is higher than the best by more.
  double excess() const { return excess_; }

 private:
  static constexpr std::size_t kMaxTops = 6;
  static InnerPolytope& kept_polytope();

  bool enclose_origin();
  void expand();
  void set_goal();
  Vector3 evaluate(const Vector3& normal);
  void climb_if_higher();
  void climb_from(const Vector3& normal);
  void keep_top(const LocalCandidate& top);
  void climb_from_tops();
  bool may_continue() const {
    return status_ != Status::InvalidInput && rule_.with_at_most(limits_.max_evaluations).may_evaluate();
  }
  /// Whether the bodies without their balls are apart. A climb has then found the only maximum.
  bool is_apart() const { return best_.s + rho_ > 0; }
  double width() const { return std::max(-limits_.relative_width * best_.s, rule_.tolerance()); }

  GapFunction& gap_;
  CuttingPlanes& cuts_;
  Ascent& ascent_;
  const StoppingRule& rule_;
  const double rho_;          // m
  InnerPolytope polytope_;    // of the points d + rho n
  bool is_enclosed_ = false;  // whether it contains the origin; until then it still has the points of an earlier query
  SearchLimits limits_{};
  double excess_ = 0;                          // m
  std::array<LocalCandidate, kMaxTops> tops_;  // the highest normals from which there was no climb
  std::size_t top_count_ = 0;
  GapJet best_, jet_;
  double error_ = 0;  // m; from the climb to the best
  Status status_ = Status::Converged;
};

}  // namespace supernormal
