#include <algorithm>
#include <cmath>
#include <limits>

#include "method.hpp"
#include "newton_step.hpp"

namespace literature {
namespace {

using Vector4 = Eigen::Vector4d;

constexpr int kLeastStages = 10;         // from spheres to the bodies (Podlozhnyuk et al.)
constexpr double kStageAccuracy = 1e-3;  // of all stages but the last, relative to the smallest half-axis
constexpr int kMostHalvings = 26;        // to a step of 1e-8, where the line search of Podlozhnyuk et al. ends

/// A point, its multiplier mu, and the values there, in the frame of body 1.
struct MidwayIterate {
  Vector3 x;
  double mu;
  Implicit f1, f2;
  Vector4 residual;
};

class Newton {
 public:
  Newton(const Bodies& bodies, const Options& options) : bodies_(bodies), options_(options) {}

  MidwayIterate at(const Vector3& x, double mu) {
    ++evaluations_;
    MidwayIterate result{x, mu, body1_.implicit(x), body2_.implicit(bodies_.in_body2(x)), {}};
    result.f2.gradient = bodies_.rotation * result.f2.gradient;
    result.f2.hessian = bodies_.rotation * result.f2.hessian * bodies_.rotation.transpose();
    result.residual << result.f1.gradient + mu * mu * result.f2.gradient, result.f1.value - result.f2.value;
    return result;
  }

  /// Uses the multiplier that makes both gradients equally long. It is 1 at the centre of body 2, where the gradient is 0.
  MidwayIterate at(const Vector3& x) {
    MidwayIterate result = at(x, 1);
    const double length2 = result.f2.gradient.norm();
    if (length2 > 0) result.mu = std::sqrt(result.f1.gradient.norm() / length2);
    result.residual.head<3>() = result.f1.gradient + result.mu * result.mu * result.f2.gradient;
    return result;
  }

  /// The bodies of a stage, from 0 (spheres with equal products of half-axes) to 1.
  void set_stage(double share) {
    body1_ = between(bodies_.body1, share);
    body2_ = between(bodies_.body2, share);
  }

  /// Whether Newton's method converges from x.
  bool solve(Vector3& x, double accuracy) {
    MidwayIterate now = at(x);
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      if (options_.path != nullptr) options_.path->push_back((now.f1.gradient - now.f2.gradient).normalized());
      Eigen::Matrix4d jacobian;
      jacobian << now.f1.hessian + now.mu * now.mu * now.f2.hessian, 2 * now.mu * now.f2.gradient,
          (now.f1.gradient - now.f2.gradient).transpose(), 0;
      const auto found = newton_step_of_any_rank(jacobian, now.residual);  // singular where both bodies are flat
      if (!found) return false;
      const Vector4& step = *found;
      const double moved = step.head<3>().norm();
      MidwayIterate next = at(now.x - step.head<3>(), now.mu - step[3]);
      double share = 1;
      const bool is_last = moved <= accuracy * bodies_.size();
      for (int k = 0; k < kMostHalvings && !is_last && !(next.residual.norm() < now.residual.norm()); ++k) {
        share /= 2;
        next = at(now.x - share * step.head<3>(), now.mu - share * step[3]);
      }
      now = next;
      x = now.x;
      if (is_last) return now.residual.allFinite();
    }
    return false;
  }

  /// The distance from a point inside the body to the surface along a unit direction, m.
  double reach(const Superquadric& body, const Vector3& x, const Vector3& direction) {
    double distance = 0;
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      ++line_evaluations_;
      const Implicit f = body.implicit(x + distance * direction);
      const double slope = f.gradient.dot(direction);
      if (slope == 0) break;
      const double step = f.value / slope;
      distance -= step;
      if (!(std::abs(step) > options_.tolerance * bodies_.size())) return distance;
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  CommonNormal answer(const Vector3& x) {
    const MidwayIterate there = at(x);
    CommonNormal result;
    if (!there.residual.allFinite()) return result;
    result.outcome = Outcome::Apart;
    result.normal = (there.f1.gradient - there.f2.gradient).normalized();
    if (std::max(there.f1.value, there.f2.value) >= 0) return result;
    const Vector3& n = result.normal;
    const double reach1 = reach(bodies_.body1, x, n);
    const double reach2 = reach(bodies_.body2, bodies_.in_body2(x), -(bodies_.rotation.transpose() * n));
    result.point1 = x + reach1 * n;
    result.point2 = x - reach2 * n;
    result.gap = -reach1 - reach2;
    result.outcome = std::isfinite(result.gap) ? Outcome::Found : Outcome::Failed;
    return result;
  }

  /// Evaluations of both bodies. An evaluation of one body counts as half.
  int evaluations() const { return evaluations_ + line_evaluations_ / 2; }

 private:
  static Superquadric between(const Superquadric& body, double share) {
    const double radius = std::cbrt(body.half_axes.prod());
    return {Vector3::Constant((1 - share) * radius) + share * body.half_axes, 2 + share * (body.delta - 2),
            2 + share * (body.epsilon - 2)};
  }

  const Bodies& bodies_;
  const Options& options_;
  Superquadric body1_ = bodies_.body1, body2_ = bodies_.body2;
  int evaluations_ = 0, line_evaluations_ = 0;
};

}  // namespace

CommonNormal midway_point(const Bodies& bodies, const Options& options) {
  Newton newton(bodies, options);
  Vector3 x;
  bool has_converged = true;
  if (options.first_normal != nullptr) {
    const Vector3& n = *options.first_normal;
    const Vector3 m = -(bodies.rotation.transpose() * n);
    x = 0.5 * (bodies.body1.point(bodies.body1.angles_of(n)) + bodies.rotation * bodies.body2.point(bodies.body2.angles_of(m)) +
               bodies.offset);
    has_converged = newton.solve(x, options.tolerance);
  } else {
    const double radius1 = std::cbrt(bodies.body1.half_axes.prod()), radius2 = std::cbrt(bodies.body2.half_axes.prod());
    x = radius1 / (radius1 + radius2) * bodies.offset;
    const double largest = std::max({bodies.body1.delta, bodies.body1.epsilon, bodies.body2.delta, bodies.body2.epsilon});
    const int stages = std::max(kLeastStages, static_cast<int>(largest - 1));
    for (int stage = 1; stage <= stages && has_converged; ++stage) {
      newton.set_stage(static_cast<double>(stage) / stages);
      has_converged = newton.solve(x, stage < stages ? kStageAccuracy : options.tolerance);
    }
  }
  if (!has_converged) return {.evaluations = newton.evaluations()};
  CommonNormal result = newton.answer(x);
  result.evaluations = newton.evaluations();
  return result;
}

}  // namespace literature
