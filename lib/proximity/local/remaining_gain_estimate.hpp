// How much an ascent has still to gain, from what the model promised step by step.
#pragma once

#include "proximity/tangent_plane.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// Sums the gains to come as a geometric series. Its contraction is that of the gains, or of the steps where these shrink more
/// slowly, as the last two steps show it, times the factor by which the curvature has changed in between, the way that it has
/// changed most, or that of the step: where it grows or falls to infinity or nothing, the model knows as little. Where nothing has
/// been shown, or not near enough to the maximum, or where the steps hardly shrink, the slowest contraction that is believed is
/// assumed.
class RemainingGainEstimate {
 public:
  /// Where s rises like a power of the distance from the maximum, however high, the gain to come is less than twice that of the
  /// quadratic model; sums of different powers take a little more.
  static constexpr double kSafety = 3;

  /// What the model says at a normal.
  struct Promise {
    double gain;                                                             ///< m; to its maximum; infinite if it has none
    double step;                                                             ///< gnomonic; the length of the step that it takes
    Symmetric2 curvature;                                                    ///< m
    TangentPlane plane{Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()};  ///< of the curvature
    Vector2 way = Vector2::Zero();                                           ///< of the step, of any length
  };

  /// Keeps a reference. `tolerance`: m
  RemainingGainEstimate(const GapFunction& gap, double tolerance) : gap_(gap), tolerance_(tolerance) {}

  /// A new climb begins.
  void restart();

  /// The last step did not lead up: what it promised says nothing of the contraction.
  void forget() { last_.gain = 0; }

  /// Learns from the next normal, whose step is held back by a trust region of this radius: a bound on the gain to come, m.
  double learn(const Promise& now, double radius);

  /// Whether the next step is longer than the last.
  bool steps_grow() const { return steps_grow_; }

  /// Whether the curvature, as it has changed with the last step, ends within the next few: s may be level there and rise on
  /// beyond.
  bool near_degenerate_stationary_point() const { return near_degenerate_stationary_point_; }

  /// Whether there were so many steps with gains that hardly shrink that they may zigzag across a ridge, which rises where they
  /// never look. Counts anew when there were.
  bool may_zigzag();

 private:
  const GapFunction& gap_;
  const double tolerance_;
  Promise last_{0, 0, {}};  // gain 0: no history
  int slow_steps_ = 0;      // in a row
  bool steps_grow_ = false;
  bool near_degenerate_stationary_point_ = false;
};

}  // namespace supernormal
