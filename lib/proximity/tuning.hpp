// The constants that steer the solver, in one place.
#pragma once

namespace supernormal {

/// The constants that change which normals are evaluated, or when a search ends. No proved interval depends on them. They do affect
/// whether and which maximum of a deep overlap is found. `tests/ablation/run` changes one at a time and prints the costs.
struct Tuning {
  // Newton's method with the one-line bound (local/certified_newton.hpp).
  int newton_evaluations = 8;  ///< it gives up after so many; nine of ten pairs that the bound proves need fewer
  double backtrack = 0.5;      ///< factor for a step that did not lead up
  /// Relative to each component of the normal: for a smaller tilt, the steps in the normal and in the point are the same.
  double same_turn = 0.01;

  // The ascent (local/ascent.hpp).
  double longest_step = 1;  ///< gnomonic, 45 degrees: the first and the largest trust radius; no model is valid farther away
  double good_share = 0.5;  ///< of the predicted gain: a step that gains more doubles the trust radius
  /// Of the predicted gain: a step that gains less halves the trust radius. A step whose gain the cuts bound below this is not
  /// made.
  double poor_share = 0.1;
  double short_share = 1.7;  ///< of the predicted gain: if a step gains more, the model misses something, and the bounds propose
  double creep = 0.01;  ///< a step through the boundary point that is shorter than Newton's by this factor creeps along an edge
  /// The model's gain times this estimates what is left. Where s rises like a power of the distance, the model predicts at least
  /// half of it.
  double gain_safety = 3;

  // The search for other maxima of overlapping bodies (hybrid.cpp, bounds/expanding_polytope.hpp).
  double followed_depth = 0.02;  ///< of the length unit: in a shallower overlap, a warm query does not search for other maxima
  /// In units of the least radii of curvature: in a shallower overlap of smooth bodies there is no search for other maxima. With 1
  /// it is Blaschke's theorem, except that the radii are estimates.
  double depth_per_radius = 1;
  double search_width = 0.003;   ///< of the depth: the search ends when no depth can be less by more
  int search_evaluations = 200;  ///< the search also ends after so many
  /// Of the depth: the final climbs start from the normals of other basins of attraction that come this near to the best.
  double near_best = 0.03;
  /// Of the depth: a warm query leaves its tracked maximum for one that is shallower by more, so that it does not flip. Its search
  /// ends when there is none.
  double branch_gain = 0.17;
  double same_hill_cosine = 0.996;  ///< normals closer than five degrees are in the same basin of attraction
};

#ifdef SUPERNORMAL_ABLATION
inline Tuning kTuning;
#else
inline constexpr Tuning kTuning;
#endif

}  // namespace supernormal
