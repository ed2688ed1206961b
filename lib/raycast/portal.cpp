#include "raycast/portal.hpp"

#include <cmath>
#include <numbers>

namespace supernormal {
namespace {

// Relative rounding error of a few products and sums.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

Vector2 rotated_left(const Vector2& a) { return {-a.y(), a.x()}; }

}  // namespace

Portal::Portal(const Vector3& direction, double rounding)
    : v_(direction), e1_(direction.unitOrthogonal()), e2_(direction.cross(e1_)), rounding_(rounding) {}

bool Portal::add(const Vector3& d) {
  const Vertex vertex{{e1_.dot(d), e2_.dot(d)}, -v_.dot(d), d};
  const bool is_kept = is_pierced() ? refine(vertex) : narrow(vertex);
  bound_ = std::fmin(bound_, simplex_.height + simplex_.error);
  return is_kept;
}

// The sector contains all points so far. It runs counter-clockwise from the first point to the last, over less than pi.
bool Portal::narrow(const Vertex& vertex) {
  if (vertex.p.norm() <= rounding_) {
    simplex_ = {{vertex, vertex, vertex}, 2, vertex.z, rounding_, 0};
    return true;
  }
  if (is_empty_) {
    sector_ = {vertex, vertex};
    is_empty_ = false;
    return true;
  }
  const auto [first, last] = sector_;
  consider(first, vertex, simplex_);
  consider(last, vertex, simplex_);
  consider(first, last, vertex, simplex_);
  if (is_pierced()) return true;
  const bool is_before = cross(first.p, vertex.p) < 0;
  const bool is_behind = cross(last.p, vertex.p) > 0;
  if (is_before) sector_[0] = vertex;
  if (is_behind) sector_[1] = vertex;
  return is_before || is_behind;
}

// Takes the best simplex that the new point forms with the old points.
bool Portal::refine(const Vertex& vertex) {
  Simplex best;
  for (int i = 0; i < simplex_.count; ++i) {
    const Vertex& one = simplex_.vertices[static_cast<std::size_t>(i)];
    consider(one, vertex, best);
    for (int j = i + 1; j < simplex_.count; ++j) consider(one, simplex_.vertices[static_cast<std::size_t>(j)], vertex, best);
  }
  const bool rotates = best.is_as_high(simplex_) && is_in_front(vertex);
  if (!best.is_better(simplex_) && !rotates) return false;
  simplex_ = best;
  return true;
}

bool Portal::is_in_front(const Vertex& vertex) const {
  const Vector3 n = normal();
  return n.dot(simplex_.vertices[0].d - vertex.d) > rounding_ * n.norm();
}

void Portal::consider(const Vertex& a, const Vertex& b, Simplex& best) const {
  const double length_a = a.p.norm();
  const double length_b = b.p.norm();
  if (a.p.dot(b.p) > 0 || std::abs(cross(a.p, b.p)) > rounding_ * (b.p - a.p).norm()) return;
  const double sum = length_a + length_b;
  const double height = sum > 0 ? (length_b * a.z + length_a * b.z) / sum : std::fmin(a.z, b.z);
  const double steepness = sum > 0 ? std::abs(b.z - a.z) / sum : 0;
  const double error = kRounding * (std::abs(a.z) + std::abs(b.z)) + (1 + steepness) * rounding_;
  const Simplex simplex{{a, b, b}, 2, height, error, 0};
  if (simplex.is_better(best)) best = simplex;
}

void Portal::consider(const Vertex& a, const Vertex& b, const Vertex& c, Simplex& best) const {
  // Twice the areas of the triangles between the line and the edges.
  Vector3 area(cross(b.p, c.p), cross(c.p, a.p), cross(a.p, b.p));
  const Vector3 edge((c.p - b.p).norm(), (a.p - c.p).norm(), (b.p - a.p).norm());
  double sum = area.sum();
  if (sum < 0) {
    sum = -sum;
    area = -area;
  }
  if (!(sum > rounding_ * edge.maxCoeff()) || (area + rounding_ * edge).minCoeff() < 0) return;
  const Vector3 z(a.z, b.z, c.z);
  const double height = area.dot(z) / sum;
  const double length_a = a.p.norm(), length_b = b.p.norm(), length_c = c.p.norm();
  const Vector3 largest(length_b * length_c, length_c * length_a, length_a * length_b);
  const double spread = largest.dot((z.array() - height).abs().matrix());
  const double steepness = ((b.z - a.z) * (c.p - a.p) - (c.z - a.z) * (b.p - a.p)).norm() / sum;
  const double error = kRounding * (spread / sum + z.lpNorm<Eigen::Infinity>()) + (1 + steepness) * rounding_;
  const Simplex simplex{{a, b, c}, 3, height, error, 0.5 * sum};
  if (simplex.is_better(best)) best = simplex;
}

double Portal::support_bound(const Vector3& m) const {
  double least = std::numeric_limits<double>::infinity();
  if (!is_pierced()) {
    if (!is_empty_) least = std::fmin(m.dot(sector_[0].d), m.dot(sector_[1].d));
    return least;
  }
  for (const Vertex& vertex : simplex_.vertices) least = std::fmin(least, m.dot(vertex.d));
  return least;
}

Vector3 Portal::normal() const {
  const auto& [a, b, c] = simplex_.vertices;
  const Vector3 one = b.d - a.d;
  if (simplex_.count == 2) {
    const double squared = one.squaredNorm();
    return squared > 0 ? Vector3(one * (v_.dot(one) / squared) - v_) : Vector3(-v_);
  }
  const Vector3 across = one.cross(c.d - a.d);
  return across.dot(v_) <= 0 ? across : Vector3(-across);
}

bool Portal::may_separate(const Vector3& w) const { return !is_pierced() && w.dot(sector_[0].d) > 0 && w.dot(sector_[1].d) > 0; }

Vector3 Portal::bisector() const {
  const Vector2& a = sector_[0].p;
  const Vector2& b = sector_[1].p;
  return lift(a * b.norm() + b * a.norm());
}

Vector3 Portal::edge_normal() const {
  const Vector2 edge = sector_[1].p - sector_[0].p;
  return edge.squaredNorm() > 0 ? lift(-rotated_left(edge)) : bisector();
}

double Portal::sector() const {
  if (is_empty_) return 2 * std::numbers::pi;
  const Vector2 a = sector_[0].p.normalized();
  const Vector2 b = sector_[1].p.normalized();
  return 2 * std::atan2((a + b).norm(), (a - b).norm());
}

}  // namespace supernormal
