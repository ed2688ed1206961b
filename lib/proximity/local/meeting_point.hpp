// Where two bodies that both have faces or straight edges touch.
#pragma once

#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The end of an ascent of two bodies with kinks. The ascent knows the vertices of body 2 only (VertexCache), and finds those of
/// body 1 by its cuts; here both are known.
///
///  1. Near a normal s is the least of smooth functions, one for each pair of an active vertex of body 1 and one of body 2: the
///     pieces of a PiecewiseModel.
///  2. Pieces meet at its maximum. Their weights, whose sum of gradients vanishes across the normal, make one point of each body
///     from the vertices: where the two faces or edges with this normal are nearest to each other. Two edges touch where they
///     cross, and not at their ends.
///  3. If these points are not opposite one another, the maximum is beside the normal, which then moves there.
class MeetingPoint {
 public:
  /// Keeps a reference.
  explicit MeetingPoint(GapFunction& gap) : gap_(gap) {}

  /// Moves the witness points of `jet`, which are any points of the faces or edges that have its normal, to where these meet, and
  /// its normal while the points are more than `tolerance` (m) beside one another, in no more than so many evaluations of the gap
  /// function since it was made. Witness points stay in their tangent planes. Returns whether the normal has moved.
  bool settle(double tolerance, int max_evaluations, GapJet& jet);

  /// m; how much higher than `jet` the maximum of the pieces near its normal is.
  double remaining_gain(const GapJet& jet) const;

  /// Moves the witness points of `jet` to those that meet, if these are nearer to each other across the normal, and not farther
  /// below their tangent planes than `largest_drop` (m).
  void move_witnesses(double largest_drop, GapJet& jet) const;

 private:
  struct Maximum;
  Maximum maximum_near(const GapJet& jet) const;
  bool climb(GapJet& jet);

  GapFunction& gap_;
};

}  // namespace supernormal
