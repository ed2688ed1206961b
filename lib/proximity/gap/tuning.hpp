// The constants that steer the solver, in one place.
#pragma once

namespace supernormal {

/// The constants that change which normals are evaluated, or when a search ends. No proved interval depends on them. They do affect
/// whether and which maximum of a deep overlap is found. `tests/ablation/run` changes one at a time and prints the costs. Where it
/// finds none, the comment has the other reason.
struct Tuning {
  // Newton's method with the one-line bound (local/certified_newton.hpp).
  /// It gives up after so many. Saves time, not evaluations: without it every query is an ascent, whose steps cost more. With 8
  /// bricks that lie half on one another take up to 40 % more instructions.
  int newton_evaluations = 16;
  /// Relative to each component of the normal: for a smaller tilt, the step in the point costs more than it gains. Saves time, not
  /// evaluations: with 0.01 cold queries take up to 8 % more instructions. With 1 they take up to 4 % less, but on sides of
  /// exponents from 50 to 200 a point ends 1e-4 sizes off that should be within 1e-5 at the tolerance 1e-12.
  double same_tilt = 0.3;

  // The ascent (local/ascent.hpp).
  double longest_step = 1;  ///< gnomonic, 45 degrees: the first and the largest trust radius; no model is valid farther away
  /// Of the predicted gain: a step that gains less halves the trust radius. A step whose gain the cuts bound below this is not
  /// made.
  double poor_fraction = 0.1;
  /// Of the predicted gain: if a step gains more, the model misses something, and the bounds propose. Without it a touching pair of
  /// octahedra without Hessians takes a thousand evaluations (tests/proximity/contract_test.cpp).
  double short_fraction = 1.7;
  double creep = 0.01;  ///< a step through the boundary point that is shorter than Newton's by this factor creeps along an edge
  /// The model's gain times this estimates what is left. Where s rises like a power of the distance, the model predicts at least
  /// half of it.
  double gain_safety = 3;

  // The search for other maxima of overlapping bodies (hybrid.cpp, bounds/expanding_polytope.hpp).
  /// Of the length unit: in a shallower overlap, a warm query does not search for other maxima, and a point of both bodies proves
  /// the overlap. So bricks that lie on one another take 2.0 evaluations, and not 4.1 (tests_proximity -tc="bricks that lie*").
  double unsearched_depth = 0.02;
  /// In units of the least radii of curvature: in a shallower overlap of smooth bodies there is no search for other maxima. With 1
  /// it is Blaschke's theorem, except that the radii are estimates.
  double depth_per_radius = 1;
  double search_width = 0.003;   ///< of the depth: the search ends when no depth can be less by more
  int search_evaluations = 200;  ///< the search also ends after so many
  /// Of the depth: the final climbs start from the normals of other basins of attraction that come this near to the best.
  double near_best = 0.03;
  /// Of the depth: a warm query leaves its tracked maximum for one that is shallower by more, so that it does not flip. Its search
  /// ends when there is none. Bodies that pass through one another need it (tests_ode -tc="geoms that pass slowly*").
  double leaving_gain = 0.17;
  double same_basin_cosine = 0.996;  ///< normals closer than five degrees are in the same basin of attraction
};

#ifdef SUPERNORMAL_ABLATION
inline Tuning kTuning;
#else
inline constexpr Tuning kTuning;
#endif

}  // namespace supernormal
