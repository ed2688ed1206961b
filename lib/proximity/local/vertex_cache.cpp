#include "proximity/local/vertex_cache.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace supernormal {
namespace {

// In units of the last place of the coordinates: vertices whose heights along a normal differ by less are tied. The normal of an
// edge is itself rounded.
constexpr double kTieUnits = 16;

}  // namespace

PiecewiseModel::Peak VertexCache::project_witness(GapJet& jet, ActiveVertices& here) {
  here.clear();
  const Vector3 toward = jet.jet2.r - gap_.rotation().transpose() * jet.d;  // body 1's boundary point in body 2's frame
  gap_.shape2().add_active_vertices(jet.m, toward, here);
  collect(jet, here, TangentPlane::at(jet.n));
  if (here.is_partial()) cache(jet.jet2.r);
  // Only the pieces that are tied here, as if they met exactly.
  const double lowest = lowest_value({pieces_.data(), count_});
  std::size_t tied = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    const double rounding = kTieUnits * std::numeric_limits<double>::epsilon() * (vertices_[k].norm() + jet.jet2.r.norm());
    if (pieces_[k].value > lowest + rounding) continue;
    vertices_[tied] = vertices_[k];
    pieces_[tied++] = {0, pieces_[k].slope};
  }
  const auto nearest = PiecewiseModel{{pieces_.data(), tied}, {1, 0, 1}}.maximize();
  jet.jet2.r.setZero();
  for (std::size_t i = 0; i < nearest.count; ++i) jet.jet2.r += nearest.weight[i] * vertices_[nearest.active[i]];
  jet.d = gap_.rotation() * jet.jet2.r + (gap_.offset() - jet.jet1.r);
  return nearest;
}

Vector3 VertexCache::exact_normal(GapJet jet) {
  ActiveVertices here;
  const PiecewiseModel::Peak active = project_witness(jet, here);
  return shared_normal(active, jet.n).normalized();
}

std::span<const Piece> VertexCache::pieces(const GapJet& jet, const ActiveVertices& here, const TangentPlane& plane1) {
  collect(jet, here, plane1);
  return {pieces_.data(), count_};
}

void VertexCache::collect(const GapJet& jet, const ActiveVertices& here, const TangentPlane& plane1) {
  count_ = 0;
  for (int k = 0; k < here.size(); ++k) add_piece(jet, here[k], plane1);
  // A body may have nonsmooth points and return no active vertices. It still has a boundary point.
  if (count_ == 0) add_piece(jet, jet.jet2.r, plane1);
  if (!here.is_partial()) return;
  const std::size_t named = count_;
  for (std::size_t k = 0; k < std::min(earlier_count_, kEarlier); ++k) {
    if (std::find(vertices_.begin(), vertices_.begin() + named, earlier_[k]) == vertices_.begin() + named) {
      add_piece(jet, earlier_[k], plane1);
    }
  }
}

void VertexCache::add_piece(const GapJet& jet, const Vector3& vertex, const TangentPlane& plane1) {
  vertices_[count_] = vertex;
  pieces_[count_].value = std::max(jet.jet2.h - jet.m.dot(vertex), 0.0);
  pieces_[count_].slope = plane1.project(difference(jet, count_));
  ++count_;
}

void VertexCache::cache(const Vector3& vertex) {
  const auto end = earlier_.begin() + std::min(earlier_count_, kEarlier);
  if (std::find(earlier_.begin(), end, vertex) != end) return;
  earlier_[earlier_count_++ % kEarlier] = vertex;
}

Vector3 VertexCache::difference(const GapJet& jet, std::size_t k) const {
  return gap_.rotation() * vertices_[k] + (gap_.offset() - jet.jet1.r);
}

Vector3 VertexCache::shared_normal(const PiecewiseModel::Peak& peak, const Vector3& direction) const {
  if (peak.count == 1) return direction;
  const Vector3& first = vertices_[peak.active[0]];
  const Vector3 edge = gap_.rotation() * (vertices_[peak.active[1]] - first);
  if (peak.count == 2) return direction - edge * (edge.dot(direction) / edge.squaredNorm());
  const Vector3 normal = edge.cross(Vector3(gap_.rotation() * (vertices_[peak.active[2]] - first)));
  const double length = normal.norm() / direction.norm();
  return normal.dot(direction) < 0 ? Vector3(-normal / length) : Vector3(normal / length);
}

}  // namespace supernormal
