#include "proximity/bounds/minimum_norm_point.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace supernormal {
namespace {

// Relative to the lengths involved. The search ends if no point's height along the best is less than the best's length by more than
// this. The error of a determinant of three vectors is below this fraction of the product of their lengths.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

Vector3 unit(const Vector3& v) {
  const double length = v.norm();
  return length > 0 ? Vector3(v / length) : Vector3(Vector3::Zero());
}

}  // namespace

const MinimumNormPoint& MinimumNormSearch::update(std::span<const Vector3> points) {
  const double before = best_.norm;
  search(points);
  // The last simplex may be thin and limited by rounding where another simplex is not.
  if (!(best_.norm < before) && best_.norm > 0) {
    *this = {};
    search(points);
  }
  return best_;
}

void MinimumNormSearch::search(std::span<const Vector3> points) {
  const auto is_shorter = [](const Vector3& a, const Vector3& b) { return a.squaredNorm() < b.squaredNorm(); };
  const double largest = std::max_element(points.begin(), points.end(), is_shorter)->norm();
  if (count_ == 0) offer(*std::min_element(points.begin(), points.end(), is_shorter));
  for (std::size_t step = 0; step < 2 * points.size(); ++step) {
    const Vector3 normal = best_.normal;
    const auto is_lower = [&](const Vector3& a, const Vector3& b) { return a.dot(normal) < b.dot(normal); };
    const Vector3& lowest = *std::min_element(points.begin(), points.end(), is_lower);
    if (!(lowest.dot(normal) < best_.norm - kRounding * largest) || !add(lowest)) break;
  }
}

bool MinimumNormSearch::add(const Vector3& vertex) {
  const std::array<Vector3, 3> old = vertices_;
  const std::size_t old_count = count_;
  if (old_count == 3 && is_origin_inside(vertex)) {
    best_ = {Vector3::Zero(), 0, Vector3::Zero()};
    around_ = {old[0], old[1], old[2], vertex};
    return true;
  }
  const double before = best_.norm;
  offer(vertex);
  for (std::size_t i = 0; i < old_count; ++i) offer(vertex, old[i]);
  for (std::size_t i = 0; i < old_count; ++i) {
    for (std::size_t j = 0; j < i; ++j) offer(vertex, old[i], old[j]);
  }
  return best_.norm < before;
}

bool MinimumNormSearch::is_better(const Vector3& point, const Vector3& direction) {
  const double norm = point.norm();
  if (!(norm < best_.norm)) return false;
  best_ = {point, norm, unit(direction)};
  return true;
}

void MinimumNormSearch::offer(const Vector3& a) {
  if (!is_better(a, a)) return;
  vertices_[0] = a;
  count_ = 1;
}

void MinimumNormSearch::offer(const Vector3& a, const Vector3& b) {
  const Vector3 edge = b - a;
  const double weight = -a.dot(edge), squared = edge.squaredNorm();
  if (!(weight > 0 && weight < squared)) return;
  Vector3 point = a + weight / squared * edge;
  // Weights on a long edge have rounding errors, which a second pass removes.
  const double more = -point.dot(edge), refined = weight + more;
  if (refined > 0 && refined < squared) point += more / squared * edge;
  if (!is_better(point, point)) return;
  vertices_ = {a, b, b};
  count_ = 2;
}

void MinimumNormSearch::offer(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  const double of_b = -a.cross(c - a).dot(normal), of_c = -(b - a).cross(a).dot(normal);
  if (!(of_b > 0 && of_c > 0 && of_b + of_c < squared)) return;
  Vector3 point = a + of_b / squared * (b - a) + of_c / squared * (c - a);
  // The same for a sliver.
  const double more_of_b = -point.cross(c - a).dot(normal), more_of_c = -(b - a).cross(point).dot(normal);
  const double refined_b = of_b + more_of_b, refined_c = of_c + more_of_c;
  if (refined_b > 0 && refined_c > 0 && refined_b + refined_c < squared) {
    const Vector3 refined = point + more_of_b / squared * (b - a) + more_of_c / squared * (c - a);
    if (refined.squaredNorm() < point.squaredNorm()) point = refined;
  }
  if (!is_better(point, std::copysign(1, a.dot(normal)) * normal)) return;
  vertices_ = {a, b, c};
  count_ = 3;
}

bool MinimumNormSearch::is_origin_inside(const Vector3& vertex) const {
  const auto& [a, b, c] = vertices_;
  const auto side = [](const Vector3& p, const Vector3& q, const Vector3& r) {
    const double determinant = p.dot(q.cross(r)), rounding = kRounding * p.norm() * q.norm() * r.norm();
    return determinant > rounding ? 1 : determinant < -rounding ? -1 : 0;
  };
  const int first = side(a, b, c);
  return first != 0 && side(vertex, c, b) == first && side(a, c, vertex) == first && side(a, vertex, b) == first;
}

MinimumNormPoint minimum_norm_point(std::span<const Vector3> points) { return MinimumNormSearch().update(points); }

std::optional<std::array<Vector3, 4>> enclosing_tetrahedron(std::span<const Vector3> points) {
  MinimumNormSearch search;
  search.update(points);
  return search.around();
}

}  // namespace supernormal
