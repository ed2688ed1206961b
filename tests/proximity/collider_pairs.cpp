#include "collider_pairs.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "supernormal/shapes/box.hpp"
#include "supernormal/shapes/capsule.hpp"
#include "supernormal/shapes/cylinder.hpp"
#include "supernormal/shapes/polytope.hpp"
#include "support/reference_pairs.hpp"

namespace supernormal::test {
namespace {

constexpr double kSmallest = 0.05, kLargest = 1;     // m; half-axes and half-lengths
constexpr double kSharpest = 1.02, kFlattest = 200;  // exponents
constexpr double kEllipsoidShare = 0.2, kExtremeShare = 0.3;
constexpr int kMinHullPoints = 8, kMaxHullPoints = 100;

// Tolerances of placing, relative to the unit: the gap is evaluated at this exactly, and the last step is no longer than that.
constexpr double kPlacingWidth = 1e-4, kPlacingStep = 1e-3;
constexpr int kMaxPlacings = 60;

/// Moves the collider along `direction` until the gap is `gap`. The gap is a convex function of the distance (the maximum of
/// linear ones), with the share of the normal in the direction as its slope: Newton's method converges from afar.
void place(ColliderPair& pair, const Vector3& direction, double gap) {
  double way = 2 * pair.size;
  for (int k = 0; k < kMaxPlacings; ++k) {
    pair.pose.position = way * direction;
    const GapBounds here = bound_gap(*pair.body, {}, *pair.shape, pair.pose, kPlacingWidth * pair.unit);
    const double step = (gap - here.lower) / here.normal.dot(direction);
    way += step;
    if (std::abs(step) <= kPlacingStep * pair.unit) break;
  }
  // The last placing is exact, so that touching pairs touch.
  pair.pose.position = way * direction;
  const GapBounds here = bound_gap(*pair.body, {}, *pair.shape, pair.pose, kReferenceWidth * pair.unit);
  pair.pose.position = (way + (gap - here.lower) / here.normal.dot(direction)) * direction;
}

}  // namespace

const char* name_of(ColliderKind kind) {
  switch (kind) {
    case ColliderKind::Box:
      return "box";
    case ColliderKind::Capsule:
      return "capsule";
    case ColliderKind::Cylinder:
      return "cylinder";
    case ColliderKind::Triangle:
      return "triangle";
    case ColliderKind::Hull:
      return "hull";
  }
  throw std::logic_error("no such collider");
}

std::unique_ptr<const Shape> Collider::make() const {
  switch (kind) {
    case ColliderKind::Box:
      return std::make_unique<Box>(lengths);
    case ColliderKind::Capsule:
      return std::make_unique<Capsule>(lengths.x(), lengths.y());
    case ColliderKind::Cylinder:
      return std::make_unique<Cylinder>(lengths.x(), lengths.y());
    case ColliderKind::Triangle:
    case ColliderKind::Hull:
      return std::make_unique<Polytope>(points);
  }
  throw std::logic_error("no such collider");
}

Collider Collider::scaled(double factor) const {
  Collider result = *this;
  result.lengths *= factor;
  for (Vector3& point : result.points) point *= factor;
  return result;
}

double ColliderPairs::exponent() {
  if (uniform(0, 1) >= kExtremeShare) return log_uniform(kSharpest, kFlattest);
  constexpr std::array kExtremes = {kSharpest, 2.0, kFlattest};
  return kExtremes[static_cast<std::size_t>(whole(0, 2))];
}

Superellipsoid ColliderPairs::surface() {
  const Vector3 axes = log_within(kSmallest, kLargest);
  if (uniform(0, 1) < kEllipsoidShare) return {axes, 2, 2};
  const double delta = exponent();
  return {axes, delta, exponent()};
}

Collider ColliderPairs::collider() {
  Collider result{kind_, log_within(kSmallest, kLargest), {}};
  if (kind_ != ColliderKind::Triangle && kind_ != ColliderKind::Hull) return result;
  const int count = kind_ == ColliderKind::Triangle ? 3 : whole(kMinHullPoints, kMaxHullPoints);
  Vector3 mean = Vector3::Zero();
  for (int k = 0; k < count; ++k) {
    result.points.emplace_back(result.lengths.cwiseProduct(Vector3{gauss(), gauss(), gauss()}));
    mean += result.points.back() / count;
  }
  for (Vector3& point : result.points) point -= mean;
  return result;
}

ColliderPair ColliderPairs::draw(double nominal) {
  ColliderPair pair{.name = std::string(name_of(kind_)) + " " + std::to_string(drawn_++),
                    .nominal = nominal,
                    .surface = surface(),
                    .body = nullptr,
                    .collider = collider(),
                    .shape = nullptr,
                    .pose = {},
                    .unit = 0,
                    .size = 0,
                    .reference = {}};
  pair.body = make_shape(pair.surface);
  pair.shape = pair.collider.make();
  const Vector3 half1 = pair.body->half_extents(), half2 = pair.shape->half_extents();
  pair.unit = kind_ == ColliderKind::Triangle ? half1.minCoeff() : std::min(half1.minCoeff(), half2.minCoeff());
  pair.size = half1.norm() + 2 * half2.norm();
  pair.pose.rotation = rotation();
  place(pair, direction(), nominal * pair.unit);
  pair.reference = bound_gap(*pair.body, {}, *pair.shape, pair.pose, kReferenceWidth * pair.unit);
  return pair;
}

std::string describe(const ColliderPair& pair) {
  std::ostringstream out;
  out.precision(17);
  const Eigen::IOFormat row(17, Eigen::DontAlignCols, ", ", ", ", "", "", "{", "}");
  out << pair.name << " nominal " << pair.nominal << " unit " << pair.unit << " half-axes " << pair.surface.half_axes().format(row)
      << " exponents " << pair.surface.delta() << ", " << pair.surface.epsilon() << " position " << pair.pose.position.format(row)
      << " rotation (row-major) " << pair.pose.rotation.format(row);
  if (pair.collider.points.empty()) out << " lengths " << pair.collider.lengths.format(row);
  for (const Vector3& point : pair.collider.points) out << " point " << point.format(row);
  out << " reference gap " << pair.reference.lower << " normal " << pair.reference.normal.format(row);
  return out.str();
}

}  // namespace supernormal::test
