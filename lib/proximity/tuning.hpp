// The constants that steer the solver, in one place.
#pragma once

namespace supernormal {

/// The constants that change which normals are evaluated or when a search ends. No proved interval depends on them; which maximum
/// of a deep overlap is found, and whether it is found, does. `tests/ablation/run` changes one at a time and prints what that
/// costs.
struct Tuning {
  // Newton's method with the one-line bound (local/certified_newton.hpp).
  int newton_evaluations = 8;  ///< it gives up after so many: nine of ten pairs that the bound proves need fewer
  double backtrack = 0.5;      ///< factor of a step that did not lead up
  double same_turn = 0.01;     ///< share of each component of the normal: a smaller turn is the same in the normal and in the point

  // The ascent (local/ascent.hpp).
  double longest_step = 1;  ///< gnomonic, 45 degrees: the first and the largest trust radius; no model is right farther away
  double good_share = 0.5;  ///< of the promised gain: a step that brings more doubles the trust radius
  double poor_share = 0.1;  ///< of the promised gain: a step that brings less halves it, and one that cuts hold below is not made
  double short_share =
      1.7;                 ///< of the promised gain: the model that is exceeded by more sees too little; the bounds propose instead
  double creep = 0.01;     ///< a step through the boundary point that is shorter than Newton's by this factor creeps along an edge
  double gain_safety = 3;  ///< the model's gain times this estimates what is left: where s rises like a power of the distance,
                           ///< the model sees at least half of it

  // The search for other maxima of overlapping bodies (hybrid.cpp, bounds/expanding_polytope.hpp).
  double followed_depth = 0.02;  ///< of the length unit: shallower, a warm query follows its branch without a look at others
  double depth_per_radius = 1;   ///< between smooth bodies no other maximum is looked for while the depth is less than so many of
                                 ///< the least radii of curvature: with 1 it is Blaschke's theorem, but for the estimate of these
  double search_width = 0.003;   ///< of the depth: the search ends when no depth can be less by more
  int search_evaluations = 200;  ///< or after so many
  double near_best = 0.03;       ///< of the depth: other hills whose normals come as near to the best are climbed in the end
  double branch_gain = 0.17;  ///< of the depth: a warm query leaves its branch for one that is shallower by more, so that it does
                              ///< not flip, and its search ends when there is none
  double same_hill_cosine = 0.996;  ///< normals closer than five degrees lead up the same hill
};

#ifdef SUPERNORMAL_ABLATION
inline Tuning kTuning;
#else
inline constexpr Tuning kTuning;
#endif

}  // namespace supernormal
