// What goes into a query of many pairs in lanes, and what comes out. Plain numbers: the files compiled for wide registers see no
// other type (shapes/lanes/real.hpp).
#pragma once

#include "proximity/gap/limits.hpp"
#include "supernormal/shapes/lane_body.hpp"

namespace supernormal {

/// A pair of bodies. Positions in m; rotations by columns, as Eigen stores them.
struct LanePair {
  const LaneBody *body1, *body2;
  const double *position1, *rotation1, *position2, *rotation2;
  const double* first_normal;  ///< unit to 1e-6, body 1's frame, or null
};

/// What all pairs have in common.
struct LaneSettings {
  double tolerance;      ///< Settings::tolerance
  int most_evaluations;  ///< of one pair without tilts, at least 1 and at most kMostLaneEvaluations
  int most_rounds;       ///< with tilts
  bool stop_when_apart;  ///< Settings::stop_when_apart
  /// In a shallower overlap the maximum of a first normal is followed, without a proof. The larger of both limits counts.
  double followed_depth;       ///< of the length unit
  double followed_per_radius;  ///< of the sum of both bodies' LaneBody::curvature_radius
  bool wants_curvature;        ///< whether to find LaneAnswer::curvature
};

inline constexpr int kMostLaneEvaluations = 16;
inline constexpr int kMostLaneRounds = kMostLaneEvaluations + limits::kMostTilts;
inline constexpr double kUnknownCurvature = -1;

enum class LaneOutcome {
  Open,              ///< nothing is proved: the search goes on elsewhere from `normal`, with the cuts
  Apart,             ///< `normal` proves separation, and the settings ask for no more
  Proved,            ///< the answer is complete
  ProvedButContact,  ///< the maximum is proved, and the place of the contact takes more than a formula
};

/// The columns of an evaluation, in body 1's frame. Symmetric matrices: xx, yy, zz, xy, xz, yz.
inline constexpr int kFoundS = 0;                         // m
inline constexpr int kFoundError = kFoundS + 1;           // m; the bound on what is left
inline constexpr int kFoundNormal = kFoundError + 1;      // unit
inline constexpr int kFoundD = kFoundNormal + 3;          // m; from the boundary point of body 1 to that of body 2
inline constexpr int kFoundR = kFoundD + 3;               // m; the boundary point of body 1
inline constexpr int kFoundH = kFoundR + 3;               // m; the support function of body 1
inline constexpr int kFoundHessian1 = kFoundH + 1;        // m; of body 1
inline constexpr int kFoundHessian = kFoundHessian1 + 6;  // m; H1 + H2
inline constexpr int kFoundH2 = kFoundHessian + 6;        // m; the support function of body 2; the rest in its own frame
inline constexpr int kFoundR2 = kFoundH2 + 1;             // m; the boundary point
inline constexpr int kFoundHessian2 = kFoundR2 + 3;       // m
inline constexpr int kJetFields = kFoundHessian2 + 6;
inline constexpr int kFoundMiddle = kJetFields;        // m; the middle of the boundary points of tilted normals
inline constexpr int kFoundSpread = kFoundMiddle + 3;  // m; what is left of d there across the normal, or -1 without tilts
inline constexpr int kFoundFields = kFoundSpread + 1;

/// The answer of a pair. Apart and Proved: in the world's frame. Otherwise only `normal` (in body 1's frame), `evaluations`,
/// `jet` and the cuts are set.
struct LaneAnswer {
  LaneOutcome outcome;
  bool is_followed;  ///< Proved, but only as a local maximum, by the gain that the model leaves
  int evaluations;
  double gap, error, rounding, tolerance;  ///< m; `error` without the rounding
  double normal[3];
  double jet[kJetFields];  ///< the evaluation of `normal`; not of ellipsoids
  double point1[3], point2[3], contact[3];
  double curvature[2];  ///< 1/m; of the bodies together, the smaller first, or kUnknownCurvature; only if it is wanted
  /// m; d + rho n of every evaluation but the best; only if the outcome is Open
  double cuts[kMostLaneRounds][3];
};

/// Answers `count` pairs, all of ellipsoids (`of_ellipsoids`) or of any kind.
struct LaneKernel {
  int width;         ///< lanes
  const char* name;  ///< the width and the instruction set
  void (*query)(const LanePair* pairs, int count, bool of_ellipsoids, const LaneSettings& settings, LaneAnswer* answers);
};

/// The kernels that this processor can run, the narrowest (one lane) first.
struct LaneKernels {
  const LaneKernel* kernels[4];
  int count;
};
const LaneKernels& lane_kernels();

extern const LaneKernel kOneLane;
extern const LaneKernel kTwoLanes;
extern const LaneKernel kFourLanes;
extern const LaneKernel kEightLanes;

}  // namespace supernormal
