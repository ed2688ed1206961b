#include "proximity/local/strict_complementarity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace supernormal {
namespace {

// Share of a corner in the point of a face or an edge below which it is rounding.
constexpr double kNoWeight = 1e-12;

// ActiveVertices that share a normal; more than this are coplanar, and any three of them know the normal.
constexpr std::size_t kMaxTied = 24;

}  // namespace

// Across an edge the kink holds the normal, and on a face both ways: curvature matters only along what is free.
Symmetric2 StrictComplementarity::reduced_hessian(const Symmetric2& A, std::span<const Piece> pieces) const {
  if (Eigen2(A).low > 0) return A;
  std::array<Piece, kMaxTied> tied;
  std::size_t count = 0;
  const double level = lowest_value(pieces) + rounding_;
  for (const Piece& piece : pieces) {
    if (piece.value <= level && count < tied.size()) tied[count++] = {0, piece.slope};
  }
  const PiecewiseModel::Peak rest = holding({tied.data(), count});
  const double size = std::max(std::abs(A.xx) + std::abs(A.yy), length_unit_);
  if (rest.count == 3) return {size, 0, size};
  if (rest.count == 1) return A;
  const Vector2 across = (tied[rest.active[1]].slope - tied[rest.active[0]].slope).normalized();
  const Vector2 along(-across.y(), across.x());
  const double curvature = along.dot(A * along);
  return {curvature * along.x() * along.x() + size * across.x() * across.x(),
          curvature * along.x() * along.y() + size * across.x() * across.y(),
          curvature * along.y() * along.y() + size * across.y() * across.y()};
}

// Where the point of body 1 is beside a corner, or on an edge of the face, the others do not hold the normal.
PiecewiseModel::Peak StrictComplementarity::holding(std::span<const Piece> tied) const {
  auto rest = PiecewiseModel{tied, {1, 0, 1}}.maximize();
  for (std::size_t i = rest.count; i-- > 0;) {
    if (rest.weight[i] > kNoWeight) continue;
    rest.active[i] = rest.active[--rest.count];
  }
  return rest;
}

// What holds the normal here need not do so at the peak: on the way along an edge the curvature turns the slopes as well.
bool StrictComplementarity::is_held(const PiecewiseModel::Peak& peak, std::span<const Piece> pieces, const Symmetric2& A) const {
  std::array<Piece, 3> tied;
  for (std::size_t i = 0; i < peak.count; ++i) tied[i] = {0, pieces[peak.active[i]].slope - A * peak.u};
  return holding({tied.data(), peak.count}).count == peak.count;
}

}  // namespace supernormal
