// The contact of two bodies that both have faces or straight edges.
#pragma once

#include "proximity/gap/stopping_rule.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The end of an ascent of two bodies with nonsmooth points. The ascent knows only the vertices of body 2 (VertexCache), and finds
/// the vertices of body 1 by its cuts. Here both are known.
///
///   1. Near a normal s is the minimum of smooth functions, one for each pair of active vertices of body 1 and body 2. These are
///   the
///      pieces of a PiecewiseModel.
///   2. Pieces meet at its maximum. They have weights with which the sum of their gradients across the normal vanishes. The
///   weighted
///      mean of the vertices gives one point of each body: the nearest points of the two faces or edges with this normal. So two
///      edges touch where they cross, and not at their ends.
///   3. If these points are not opposite each other, the maximum is beside the normal, which then moves there.
class MeetingPoint {
 public:
  /// Keeps a reference.
  explicit MeetingPoint(GapFunction& gap) : gap_(gap) {}

  /// Moves the witness points of `jet`, which are any points of the faces or edges with its normal, to where these meet. Also moves
  /// the normal while the points are more than the tolerance apart across it, as long as `rule` allows evaluations. Witness points
  /// stay in their tangent planes. Returns whether the normal has moved.
  bool settle(const StoppingRule& rule, GapJet& jet);

  /// m; how much higher than `jet` the maximum of the pieces near its normal is.
  double remaining_gain(const GapJet& jet) const;

  /// Moves the witness points of `jet` to the points that meet. Does so only if these are nearer to each other across the normal,
  /// and at most `largest_separation` (m) below their tangent planes.
  void move_witnesses(double largest_separation, GapJet& jet) const;

 private:
  struct Maximum;
  Maximum maximum_near(const GapJet& jet) const;
  bool climb(GapJet& jet);

  GapFunction& gap_;
};

}  // namespace supernormal
