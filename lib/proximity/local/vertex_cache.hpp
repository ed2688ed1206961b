// The faces and straight edges of body 2 near a normal.
#pragma once

#include <array>
#include <span>

#include "proximity/local/piecewise_model.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The corners of body 2, as far as the normals evaluated so far have shown them.
///
/// The support function of a body with faces and edges is the largest of smooth ones, one for each corner p, so that near a normal
///     s(n + u) = min over p of (n + u).p - h1(n + u),
/// and each corner makes one piece of a PiecewiseModel. Where several pieces meet, the normal is that of an edge or a face, and the
/// boundary point is any point of it.
class VertexCache {
 public:
  explicit VertexCache(GapFunction& gap) : gap_(gap) {}

  /// After the evaluation of `jet`: puts the corners of body 2 near its normal into `here`, and moves jet.jet2.r to the boundary
  /// point with this normal that is nearest to that of body 1, and jet.d with it: jet.d - jet.s jet.n is then the steepest ascent.
  /// Returns the corners that it is between.
  PiecewiseModel::Peak project_witness(GapJet& jet, ActiveVertices& here);

  /// The normal that the edge or face has which holds that of `jet`, when settled: the same to rounding, but without what a normal
  /// gathers that is turned from one frame into another at every step of a simulation, until it is no longer that of the face.
  Vector3 held_normal(GapJet jet);

  /// The pieces of s over a tangent plane at `jet`, relative to jet.s. Valid, as are the next two, until the next call of a
  /// function that is not const.
  std::span<const Piece> pieces(const GapJet& jet, const ActiveVertices& here, const TangentPlane& plane1);

  /// p2 - p1 for the corner that made piece k, in body 1's frame.
  Vector3 difference(const GapJet& jet, std::size_t k) const;

  /// The normal nearest to `direction` that the active corners of a peak share, not normalised: perpendicular to their edge, or
  /// that of their face, to rounding.
  Vector3 shared_normal(const PiecewiseModel::Peak& peak, const Vector3& direction) const;

 private:
  static constexpr std::size_t kEarlier = 16;
  static constexpr std::size_t kMaxPieces = ActiveVertices::kCapacity + kEarlier;

  void collect(const GapJet& jet, const ActiveVertices& here, const TangentPlane& plane1);
  void add_piece(const GapJet& jet, const Vector3& corner, const TangentPlane& plane1);
  void remember(const Vector3& corner);

  GapFunction& gap_;
  std::array<Vector3, kEarlier> earlier_;  // of a body that does not name all of its corners at once; a ring
  std::size_t earlier_count_ = 0;
  std::array<Vector3, kMaxPieces> corners_;  // of pieces_, in body 2's frame
  std::array<Piece, kMaxPieces> pieces_;
  std::size_t count_ = 0;
};

}  // namespace supernormal
