#include "proximity/local/strict_complementarity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace supernormal {
namespace {

// A smaller weight of a vertex in the point of a face or an edge is only rounding error.
constexpr double kNoWeight = 1e-12;

// The number of vertices tied at a normal. If there are more, they are coplanar, and any three of them determine the normal.
constexpr std::size_t kMaxTied = 24;

}  // namespace

// Across an edge the nonsmooth point determines the normal, and on a face it does so in both directions. Curvature matters only
// along the remaining direction.
Symmetric2 StrictComplementarity::reduced_hessian(const Symmetric2& A, std::span<const Piece> pieces) const {
  if (Eigen2(A).low > 0) return A;
  std::array<Piece, kMaxTied> tied;
  std::size_t count = 0;
  const double level = lowest_value(pieces) + rounding_;
  for (const Piece& piece : pieces) {
    if (piece.value <= level && count < tied.size()) tied[count++] = {0, piece.slope};
  }
  const PiecewiseModel::Peak active_set = with_positive_multipliers({tied.data(), count});
  const double size = std::max(std::abs(A.xx) + std::abs(A.yy), length_unit_);
  if (active_set.count == 3) return {size, 0, size};
  if (active_set.count == 1) return A;
  const Vector2 across = (tied[active_set.active[1]].slope - tied[active_set.active[0]].slope).normalized();
  const Vector2 along(-across.y(), across.x());
  const double curvature = along.dot(A * along);
  return {curvature * along.x() * along.x() + size * across.x() * across.x(),
          curvature * along.x() * along.y() + size * across.x() * across.y(),
          curvature * along.y() * along.y() + size * across.y() * across.y()};
}

// If body 1's point is beside a vertex, or on an edge of the face, the other vertices have zero weight and do not determine the
// normal.
PiecewiseModel::Peak StrictComplementarity::with_positive_multipliers(std::span<const Piece> tied) const {
  auto active_set = PiecewiseModel{tied, {1, 0, 1}}.maximize();
  for (std::size_t i = active_set.count; i-- > 0;) {
    if (active_set.weight[i] > kNoWeight) continue;
    active_set.active[i] = active_set.active[--active_set.count];
  }
  return active_set;
}

// The vertices with positive weights here may differ from those at the peak, because along an edge the curvature changes the
// slopes.
bool StrictComplementarity::is_strict(const PiecewiseModel::Peak& peak, std::span<const Piece> pieces, const Symmetric2& A) const {
  std::array<Piece, 3> tied;
  for (std::size_t i = 0; i < peak.count; ++i) tied[i] = {0, pieces[peak.active[i]].slope - A * peak.u};
  return with_positive_multipliers({tied.data(), peak.count}).count == peak.count;
}

}  // namespace supernormal
