// The faces and straight edges of body 2 near a normal.
#pragma once

#include <array>
#include <span>

#include "proximity/local/piecewise_model.hpp"
#include "supernormal/proximity/gap_function.hpp"

namespace supernormal {

/// The vertices of body 2 that the evaluated normals have shown so far.
///
/// The support function of a body with faces and edges is the maximum of smooth functions, one for each vertex p. So near a normal
///     s(n + u) = min over p of (n + u).p - h1(n + u),
/// and each vertex gives one piece of a PiecewiseModel. Where several pieces meet, the normal is an edge's or a face's, and the
/// boundary point is any of its points.
class VertexCache {
 public:
  explicit VertexCache(GapFunction& gap) : gap_(gap) {}

  /// After the evaluation of `jet`: writes the active vertices of body 2 into `here`. Moves jet.jet2.r to the boundary point with
  /// this normal that is nearest to body 1's point, and changes jet.d with it. The steepest ascent is then jet.d - jet.s jet.n.
  /// Returns the vertices with positive weights in this point.
  PiecewiseModel::Peak project_witness(GapJet& jet, ActiveVertices& here);

  /// The exact normal of the face or edge that supports `jet`, once the ascent has settled. It equals jet.n to rounding. A normal
  /// that is rotated from frame to frame at every step of a simulation gathers rounding errors until it is no longer the face's.
  /// This one has none.
  Vector3 exact_normal(GapJet jet);

  /// The pieces of s over a tangent plane at `jet`, relative to jet.s. The result, and the results of the next two functions, are
  /// valid until the next call of a function that is not const.
  std::span<const Piece> pieces(const GapJet& jet, const ActiveVertices& here, const TangentPlane& plane1);

  /// m; p2 - p1 for the vertex p2 of piece k, in body 1's frame.
  Vector3 difference(const GapJet& jet, std::size_t k) const;

  /// The normal nearest to `direction` that the active vertices of a peak share, not normalised. It is perpendicular to their edge,
  /// or it is the normal of their face, to rounding.
  Vector3 shared_normal(const PiecewiseModel::Peak& peak, const Vector3& direction) const;

 private:
  static constexpr std::size_t kEarlier = 16;
  static constexpr std::size_t kMaxPieces = ActiveVertices::kCapacity + kEarlier;

  void collect(const GapJet& jet, const ActiveVertices& here, const TangentPlane& plane1);
  void add_piece(const GapJet& jet, const Vector3& vertex, const TangentPlane& plane1);
  void cache(const Vector3& vertex);

  GapFunction& gap_;
  std::array<Vector3, kEarlier> earlier_;  // vertices of earlier normals, if the body does not return all at once; a ring buffer
  std::size_t earlier_count_ = 0;
  std::array<Vector3, kMaxPieces> vertices_;  // of pieces_, in body 2's frame
  std::array<Piece, kMaxPieces> pieces_;
  std::size_t count_ = 0;
};

}  // namespace supernormal
