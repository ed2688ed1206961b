#include "supernormal/shapes/minkowski_sum.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace supernormal {
namespace {

/// Adds the sums of the shapes' active vertices: the eight highest along n, highest first. Equal ones are in the order of the
/// shapes' vertices, whatever the standard library is.
void add_highest_pairs(const Vector3& n, const ActiveVertices& first, const ActiveVertices& second, ActiveVertices& vertices) {
  struct Pair {
    double height;
    std::size_t index;
    Vector3 point;
  };
  std::array<Pair, std::size_t{ActiveVertices::kCapacity} * ActiveVertices::kCapacity> pairs;
  std::size_t count = 0;
  for (int i = 0; i < first.size(); ++i) {
    for (int j = 0; j < second.size(); ++j) {
      const Vector3 point = first[i] + second[j];
      pairs[count] = {n.dot(point), count, point};
      ++count;
    }
  }
  const auto end = pairs.begin() + count;
  const auto kept = std::min<std::ptrdiff_t>(end - pairs.begin(), ActiveVertices::kCapacity);
  std::partial_sort(pairs.begin(), pairs.begin() + kept, end,
                    [](const Pair& a, const Pair& b) { return a.height != b.height ? a.height > b.height : a.index < b.index; });
  for (auto pair = pairs.begin(); pair != pairs.begin() + kept; ++pair) vertices.add(pair->point);
}

}  // namespace

MinkowskiSum::MinkowskiSum(std::shared_ptr<const Shape> first, std::shared_ptr<const Shape> second)
    : first_(std::move(first)), second_(std::move(second)) {
  if (!first_ || !second_) throw std::invalid_argument(std::string(first_ ? "second" : "first") + " is null; a shape is needed");
}

ShapeTraits MinkowskiSum::traits() const {
  const ShapeTraits first = first_->traits(), second = second_->traits();
  return {.has_hessian = first.has_hessian && second.has_hessian,
          .is_symmetric = first.is_symmetric && second.is_symmetric,
          .has_nonsmooth_points = first.has_nonsmooth_points || second.has_nonsmooth_points,
          .has_flat_faces = first.has_flat_faces || second.has_flat_faces};
}

void MinkowskiSum::evaluate(const Vector3& n, Order order, Jet& jet) const {
  Jet other;
  first_->evaluate(n, order, jet);
  second_->evaluate(n, order, other);
  jet.h += other.h;
  if (order == Order::Value) return;
  jet.r += other.r;
  if (order == Order::Point || !traits().has_hessian) return;
  jet.H += other.H;
}

// The flatter shape determines the normal at its moved point. The other shape's point follows the normal.
Vector3 MinkowskiSum::advance_normal(const Vector3& n, const Jet& jet, const Vector3& dn) const {
  if (!traits().has_flat_faces) return Shape::advance_normal(n, jet, dn);
  const Jet jet1 = first_->jet(n);
  Jet jet2;
  jet2.h = jet.h - jet1.h;
  jet2.r = jet.r - jet1.r;
  jet2.H = jet.H - jet1.H;
  const bool first_moves_more = (jet1.H * dn).squaredNorm() >= (jet2.H * dn).squaredNorm();
  const bool follow_first = first_->traits().has_flat_faces && (first_moves_more || !second_->traits().has_flat_faces);
  if (follow_first) return first_->advance_normal(n, jet1, dn);
  return second_->advance_normal(n, second_->jet(n), dn);
}

// A shape without nonsmooth points contributes its boundary point. A partial list counts as complete: a partial list must hold the
// same points for every normal, and the sums need not be the same.
void MinkowskiSum::add_active_vertices(const Vector3& n, const Vector3& toward, ActiveVertices& vertices) const {
  std::array<ActiveVertices, 2> parts;
  const std::array<const Shape*, 2> shapes = {first_.get(), second_.get()};
  for (std::size_t i = 0; i < 2; ++i) {
    if (shapes[i]->traits().has_nonsmooth_points) {
      shapes[i]->add_active_vertices(n, toward - shapes[1 - i]->point(n), parts[i]);
    } else {
      parts[i].add(shapes[i]->point(n));
    }
  }
  add_highest_pairs(n, parts[0], parts[1], vertices);
}

bool MinkowskiSum::crosses_curved_face(const Vector3& from, const Vector3& to, Vector3& face) const {
  return first_->crosses_curved_face(from, to, face) || second_->crosses_curved_face(from, to, face);
}

double MinkowskiSum::min_curvature_radius_estimate() const {
  return first_->min_curvature_radius_estimate() + second_->min_curvature_radius_estimate();
}

void MinkowskiSum::add_parameter_gradient(const Vector3& n, const Vector3& /*r*/, ParameterGradient& gradient) const {
  first_->add_parameter_gradient(n, first_->point(n), gradient);
  second_->add_parameter_gradient(n, second_->point(n), gradient);
}

}  // namespace supernormal
