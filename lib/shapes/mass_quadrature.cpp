// Volume integrals of any convex body, from its support function alone.
//
// A normal with the solid angle dw belongs to the surface element D dw, where D is the product of the two principal radii. By the
// divergence theorem the volume is 1/3 int h D dw, the first moment 1/4 int h r D dw, and the second moment 1/5 int h r r^T D dw.
// These are integrals over the unit sphere. Gauss-Legendre nodes in z times equidistant nodes around z converge exponentially for a
// smooth h.
//
// The quadrature misses surfaces without a smooth D: a flat face is one normal, a straight edge an arc of normals. The missed area
// is known, because two identities need fewer derivatives. With T the sum of the radii, the area is also 1/2 int h T dw, and int T
// dw = 2 int h dw (mixed volumes; Schneider, Convex Bodies: The Brunn-Minkowski Theory, section 5.3). The missed area is part of
// the reported error.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "shapes/mass_properties.hpp"

namespace supernormal {
namespace {

// The refinement ends at this relative change between two rules.
constexpr double kRefinementTolerance = 1e-11;
constexpr int kMinRule = 8;  // number of nodes in z
constexpr int kMaxRule = 256;

using Tangents = Eigen::Matrix<double, 3, 2>;

/// Two unit vectors that complete the unit vector m to an orthonormal triple (Duff et al. 2017).
Tangents tangents(const Vector3& m) {
  const double sign = std::copysign(1.0, m.z());
  const double a = -1 / (sign + m.z());
  const double b = m.x() * m.y() * a;
  Tangents t;
  t.col(0) = Vector3(1 + sign * m.x() * m.x() * a, sign * b, -sign * m.x());
  t.col(1) = Vector3(b, sign + m.y() * m.y() * a, -m.y());
  return t;
}

/// The shape in coordinates y with x = centre + scale y. In these it is about as long as wide, so a needle is as easy as a ball.
class AffineView {
 public:
  explicit AffineView(const Shape& shape) : shape_(shape) { set(Vector3::Zero(), shape.half_extents().asDiagonal()); }

  void set(const Vector3& centre, const Matrix3& scale) {
    centre_ = centre;
    scale_ = scale;
    inverse_ = scale.inverse();
  }

  const Vector3& centre() const { return centre_; }
  const Matrix3& scale() const { return scale_; }

  /// The boundary point with the unit normal m, in the view's coordinates.
  Vector3 point(const Vector3& m) const { return inverse_ * (shape_.point((inverse_.transpose() * m).normalized()) - centre_); }

  /// The support function, the boundary point and, if `hessian`, the tangential part of the Hessian.
  Jet jet(const Vector3& m, bool hessian) const {
    const Vector3 covector = inverse_.transpose() * m;
    const double length = covector.norm();
    Jet in, out;
    shape_.evaluate(covector / length, hessian ? Order::Hessian : Order::Point, in);
    out.r = inverse_ * (in.r - centre_);
    out.h = m.dot(out.r);
    if (hessian) out.H = inverse_ * in.H * inverse_.transpose() / length;
    return out;
  }

 private:
  const Shape& shape_;
  Vector3 centre_;
  Matrix3 scale_, inverse_;
};

/// A node of the rule on the unit sphere.
struct Node {
  Vector3 m;
  double weight;
};

/// The `count` Gauss-Legendre nodes z in (-1, 1) with their weights, by Newton's method on the Legendre polynomial.
std::vector<std::pair<double, double>> gauss_legendre(int count) {
  std::vector<std::pair<double, double>> rule;
  for (int i = 0; i < count; ++i) {
    double z = std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double previous = 1, value = z;
      for (int k = 2; k <= count; ++k) previous = std::exchange(value, ((2 * k - 1) * z * value - (k - 1) * previous) / k);
      slope = count * (z * value - previous) / (z * z - 1);
      z -= value / slope;
    }
    rule.emplace_back(z, 2 / ((1 - z * z) * slope * slope));
  }
  return rule;
}

/// A rule of `count` nodes in z times twice as many around z. The nodes are half a step off the coordinate planes, where bodies
/// tend to be singular.
std::vector<Node> sphere_rule(int count) {
  std::vector<Node> nodes;
  for (const auto& [z, weight] : gauss_legendre(count)) {
    const double radius = std::sqrt(1 - z * z);
    for (int j = 0; j < 2 * count; ++j) {
      const double angle = std::numbers::pi * (j + 0.5) / count;
      nodes.push_back({Vector3(radius * std::cos(angle), radius * std::sin(angle), z), weight * std::numbers::pi / count});
    }
  }
  return nodes;
}

/// Chooses coordinates in which the boundary points of uniformly distributed normals scatter uniformly. Exact for an ellipsoid.
void balance(AffineView& view) {
  const std::vector<Node> nodes = sphere_rule(kMinRule);
  for (int pass = 0; pass < 8; ++pass) {
    Vector3 mean = Vector3::Zero();
    Matrix3 square = Matrix3::Zero();
    for (const Node& node : nodes) {
      const Vector3 r = view.point(node.m);
      const double share = node.weight / (4 * std::numbers::pi);
      mean += share * r;
      square += share * r * r.transpose();
    }
    const Matrix3 scatter = view.scale() * (3 * (square - mean * mean.transpose())) * view.scale().transpose();
    const double largest = scatter.diagonal().maxCoeff();
    if (!std::isfinite(largest)) throw std::domain_error("mass properties: the shape delivers points that are not finite");
    if (!(largest > 0)) return;  // the body is a point
    const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(scatter / largest);
    constexpr double kThinnest = 1e-12;  // ratio of lengths; thinner bodies have no volume
    const Vector3 lengths = std::sqrt(largest) * eigen.eigenvalues().cwiseMax(kThinnest * kThinnest).cwiseSqrt();
    view.set(view.centre() + view.scale() * mean, eigen.eigenvectors() * lengths.asDiagonal() * eigen.eigenvectors().transpose());
  }
}

/// The tangential Hessian dr/dm by central differences along great circles. Steps in the ratio 1 : 2 : 4 cancel two error terms
/// (Richardson). `step` (rad) is the smallest of the three.
Eigen::Matrix2d differences(const AffineView& view, const Vector3& m, const Tangents& t, double step) {
  Eigen::Matrix2d D;
  for (int axis = 0; axis < 2; ++axis) {
    const auto slope = [&](double angle) -> Eigen::Vector2d {
      const Vector3 along = std::sin(angle) * t.col(axis);
      return t.transpose() * (view.point(std::cos(angle) * m + along) - view.point(std::cos(angle) * m - along)) / (2 * angle);
    };
    const Eigen::Vector2d fine = slope(step), middle = slope(2 * step), coarse = slope(4 * step);
    D.col(axis) = (64 * fine - 20 * middle + coarse) / 45;
  }
  return D;
}

/// Sums over one rule, in the coordinates of the view.
struct Sums {
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  double escaped = 0;  // bound on the volume below surface without a smooth D

  bool is_finite() const { return std::isfinite(volume + escaped) && first.allFinite() && second.allFinite(); }
};

Sums integrate(const AffineView& view, bool has_hessian, int rule) {
  Sums sums;
  double width = 0, sum_of_radii = 0, area = 0, mixed_area = 0, farthest = 0;
  // In proportion to the distance between nodes. So refining the rule shows the error of both.
  const double step = 0.25 / rule;
  for (const Node& node : sphere_rule(rule)) {
    const Jet jet = view.jet(node.m, has_hessian);
    const Tangents t = tangents(node.m);
    const Eigen::Matrix2d H = has_hessian ? Eigen::Matrix2d(t.transpose() * jet.H * t) : differences(view, node.m, t, step);
    const double skew = 0.5 * (H(0, 1) + H(1, 0));
    const double D = node.weight * (H(0, 0) * H(1, 1) - skew * skew);
    const double T = node.weight * H.trace();
    sums.volume += jet.h * D / 3;
    sums.first += jet.h * D / 4 * jet.r;
    sums.second += jet.h * D / 5 * jet.r * jet.r.transpose();
    width += node.weight * jet.h;
    sum_of_radii += T;
    area += D;
    mixed_area += 0.5 * jet.h * T;
    farthest = std::max(farthest, std::abs(jet.h));
  }
  sums.escaped = farthest / 3 * (std::abs(mixed_area - area) + 0.5 * farthest * std::abs(2 * width - sum_of_radii));
  return sums;
}

/// The change from one rule to the next, relative to the body, which has size 1 in these coordinates.
double change(const Sums& a, const Sums& b) {
  const double difference = std::max(
      {std::abs(a.volume - b.volume), (a.first - b.first).cwiseAbs().maxCoeff(), (a.second - b.second).cwiseAbs().maxCoeff()});
  return difference / (b.volume + b.escaped);
}

/// Transforms the sums from the view's coordinates to the body's frame.
MassProperties to_body(const AffineView& view, const Sums& sums) {
  MassProperties mass;
  const double dilation = view.scale().determinant();
  const Vector3& c = view.centre();
  const Vector3 first = dilation * (view.scale() * sums.first);  // about the centre
  mass.volume = dilation * sums.volume;
  mass.centroid = mass.volume > 0 ? Vector3(c + first / mass.volume) : c;
  mass.second_moment = dilation * (view.scale() * sums.second * view.scale().transpose()) + first * c.transpose() +
                       c * first.transpose() + mass.volume * c * c.transpose();
  return mass;
}

}  // namespace

MassProperties quadrature_mass_properties(const Shape& shape) {
  const Vector3 extents = shape.half_extents();
  if (!extents.allFinite()) throw std::domain_error("mass properties: the shape delivers values that are not finite");
  if (extents.minCoeff() <= 0) return {};  // the body is a point, or flat along an axis
  AffineView view(shape);
  balance(view);

  Sums sums = integrate(view, shape.traits().has_hessian, kMinRule);
  double last = std::numeric_limits<double>::infinity();
  double before_last = last;
  for (int rule = 2 * kMinRule; rule <= kMaxRule && last > kRefinementTolerance; rule *= 2) {
    const Sums finer = integrate(view, shape.traits().has_hessian, rule);
    if (!finer.is_finite()) throw std::domain_error("mass properties: the shape delivers values that are not finite");
    before_last = std::exchange(last, change(sums, finer));
    sums = finer;
  }
  // Slow convergence is erratic too, so one small change proves little.
  const double unresolved = last > kRefinementTolerance ? 2 * std::max(last, before_last) : last;
  MassProperties mass = to_body(view, sums);
  mass.relative_error = unresolved + sums.escaped / (sums.volume + sums.escaped);
  return mass;
}

}  // namespace supernormal
