#include "supernormal/shapes/callback_shape.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/finite.hpp"
#include "base/validation.hpp"

namespace supernormal {
namespace {

constexpr int kDirections = 26;

struct Trial {
  Vector3 n;
  double h = 0;
  Vector3 r = Vector3::Zero();
};

/// The directions to the faces, edges and vertices of a cube. Direction 25 - i is opposite to direction i.
std::array<Trial, kDirections> trial_directions() {
  std::array<Trial, kDirections> trials;
  std::size_t count = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) trials[count++].n = Vector3(x, y, z).normalized();
      }
    }
  }
  return trials;
}

std::string vector_text(const Vector3& v) {
  return std::string("(") + to_text(v.x()) + ", " + to_text(v.y()) + ", " + to_text(v.z()) + ")";
}

[[noreturn]] void refuse(const std::string& what, const Vector3& n) {
  throw std::invalid_argument(what + " in the direction n = " + vector_text(n));
}

/// Refuses values that are not finite or violate n.r = h. Returns the size (m): the largest |coordinate| of a boundary point or
/// |h|.
double check_points(const std::array<Trial, kDirections>& trials) {
  double size = 0;
  for (const Trial& trial : trials) {
    if (!std::isfinite(trial.h)) refuse("support = " + to_text(trial.h) + " is not finite", trial.n);
    if (!all_finite(trial.r)) refuse("point = " + vector_text(trial.r) + " is not finite", trial.n);
    size = std::max({size, trial.r.lpNorm<Eigen::Infinity>(), std::abs(trial.h)});
  }
  require_in("size of the body", size, kMinLength, kMaxLength, "m");
  for (const Trial& trial : trials) {
    if (std::abs(trial.n.dot(trial.r) - trial.h) > kCallbackPrecision * size) {
      refuse("point.n = " + to_text(trial.n.dot(trial.r)) + " m differs from support = " + to_text(trial.h) +
                 " m by more than 1e-6 of the size " + to_text(size) + " m",
             trial.n);
    }
  }
  return size;
}

/// Refuses a width below 2 kMinLength, and a boundary point outside a supporting plane.
void check_convex(const std::array<Trial, kDirections>& trials, double size) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Trial& trial = trials[i];
    const double width = trial.h + trials[trials.size() - 1 - i].h;
    if (!(width >= 2 * kMinLength)) {
      refuse("the width support(n) + support(-n) = " + to_text(width) + " m is below 2e-30 m", trial.n);
    }
    for (const Trial& other : trials) {
      const double excess = trial.n.dot(other.r) - trial.h;
      if (excess > kCallbackPrecision * size) {
        refuse(
            "the body is not convex: point" + vector_text(other.n) + " lies " + to_text(excess) + " m outside the supporting plane",
            trial.n);
      }
    }
  }
}

void check_hessian(const Matrix3& hessian, const Vector3& n) {
  if (!all_finite(hessian)) refuse("hessian is not finite", n);
  const double largest = hessian.cwiseAbs().maxCoeff();
  if (largest == 0) return;  // the boundary point is a vertex
  const Matrix3 H = hessian / largest;
  const double asymmetry = (H - H.transpose()).cwiseAbs().maxCoeff();
  if (asymmetry > kCallbackPrecision) {
    refuse("hessian is not symmetric: entries differ by " + to_text(asymmetry) + " of the largest", n);
  }
  const double radial = (H * n).lpNorm<Eigen::Infinity>();
  if (radial > kCallbackPrecision) {
    refuse("hessian times n is not zero but " + to_text(radial) + " of the largest entry", n);
  }
  // One eigenvalue is zero. So the trace is the sum of the two principal radii, and `product` their product.
  const double product = 0.5 * (H.trace() * H.trace() - H.squaredNorm());
  if (H.trace() < 0 || product < -kCallbackPrecision) refuse("hessian has a negative principal radius", n);
}

/// An arc of the boundary between the boundary points of two normals.
struct Bend {
  Vector3 n1, r1, n2, r2;

  /// m; the mean radius of curvature of the arc
  double radius() const { return (n2 - n1).dot(r2 - r1) / (n2 - n1).squaredNorm(); }
};

const Bend& sharper(const Bend& one, const Bend& other) { return other.radius() < one.radius() ? other : one; }

/// The least radius of curvature (m) with normals perpendicular to the axis, by sampling; 0 if a whole arc has one boundary point.
/// The sharpest sampled arc is halved repeatedly, because at a vertex the radius vanishes like a power of the angle from the
/// vertex' normal.
double sharpest_bend(const Vector3& axis, const CallbackShape::Point& point) {
  constexpr int kArcs = 72;
  constexpr double kCosine = 0.9961946980917455, kSine = 0.08715574274765817;  // of an arc
  // Down to 3e-4 rad, where the rounding error of the points is still a small fraction of their distance.
  constexpr int kHalvings = 8;
  const Vector3 across = axis.unitOrthogonal();
  const auto bend_from = [&](const Vector3& n1, const Vector3& r1) -> Bend {
    const Vector3 n2 = (kCosine * n1 + kSine * axis.cross(n1)).normalized();
    return {n1, r1, n2, point(n2)};
  };
  Bend bend = bend_from(across, point(across));
  Bend sharpest = bend;
  for (int arc = 1; arc < kArcs; ++arc) {
    bend = bend_from(bend.n2, bend.r2);
    sharpest = sharper(sharpest, bend);
  }
  for (int k = 0; k < kHalvings; ++k) {
    const Vector3 n = (sharpest.n1 + sharpest.n2).normalized();
    const Vector3 r = point(n);
    sharpest = sharper({sharpest.n1, sharpest.r1, n, r}, {n, r, sharpest.n2, sharpest.r2});
  }
  return std::max(sharpest.radius(), 0.0);
}

/// The least radius of curvature (m) around the nine axes through faces and edges of a cube.
double estimate_min_curvature_radius(const CallbackShape::Point& point) {
  double radius = std::numeric_limits<double>::infinity();
  const std::array<Trial, kDirections> trials = trial_directions();
  for (std::size_t i = 0; i < trials.size() / 2; ++i) {  // opposite axes have the same circle
    if (trials[i].n.cwiseAbs().minCoeff() == 0) radius = std::min(radius, sharpest_bend(trials[i].n, point));
  }
  return radius;
}

}  // namespace

CallbackShape::CallbackShape(Support support, Point point, Hessian hessian)
    : support_(std::move(support)), point_(std::move(point)), hessian_(std::move(hessian)) {
  if (!support_) throw std::invalid_argument("the support function is missing");
  if (!point_) throw std::invalid_argument("the point function is missing");
  std::array<Trial, kDirections> trials = trial_directions();
  for (Trial& trial : trials) {
    trial.h = support_(trial.n);
    trial.r = point_(trial.n);
  }
  check_convex(trials, check_points(trials));
  half_extents_ = Shape::half_extents();
  bounding_radius_ = Shape::bounding_radius();
  min_curvature_radius_ = estimate_min_curvature_radius(point_);
  if (!hessian_) return;
  for (const Trial& trial : trials) check_hessian(hessian_(trial.n), trial.n);
}

void CallbackShape::evaluate(const Vector3& n, Order order, Jet& jet) const {
  jet.h = support_(n);
  if (order == Order::Value) return;
  jet.r = point_(n);
  if (order == Order::Point || !hessian_) return;
  jet.H = hessian_(n);
}

}  // namespace supernormal
