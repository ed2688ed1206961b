#include "extent.hpp"

#include <algorithm>
#include <cmath>

#include "newton_step.hpp"

namespace literature {
namespace {

using Vector4 = Eigen::Vector4d;

struct Iterate {
  Vector4 unknowns;  // x and the multiplier
  Implicit f;
  Vector4 residual;  // of the gradient, scaled by the multiplier, and of the function

  Iterate(const Superquadric& body, const Vector3& direction, const Vector4& at)
      : unknowns(at), f(body.implicit(at.head<3>())), residual() {
    residual << at[3] * f.gradient - direction, f.value;
  }
};

}  // namespace

Extent extent_by_newton(const Superquadric& body, const Vector3& direction, double tolerance) {
  constexpr int kMostIterations = 30, kMostHalvings = 26;
  constexpr double kOnSurface = 1e-6;  // of F; a short step alone may come from a steep function
  const Vector3 stretched = body.half_axes.cwiseProduct(direction);
  Vector3 x = stretched / stretched.norm();
  // Start at the vertex of a body with flat faces: the point is near it for most directions.
  if (std::min(body.delta, body.epsilon) > 2) x = direction.cwiseSign();
  x = body.half_axes.cwiseProduct(x);
  x /= std::pow(body.value(x) + 1, 1 / body.epsilon);  // F + 1 is homogeneous of degree epsilon
  Vector4 start;
  start << x, 1 / body.implicit(x).gradient.norm();
  Iterate now(body, direction, start);
  Extent result{.evaluations = 2};
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    Eigen::Matrix4d jacobian;
    jacobian << now.unknowns[3] * now.f.hessian, now.f.gradient, now.f.gradient.transpose(), 0;
    const auto found = newton_step_of_any_rank(jacobian, now.residual);  // singular where the body is flat
    if (!found) break;
    const Vector4& step = *found;
    const bool is_last = step.head<3>().norm() <= tolerance * body.half_axes.minCoeff();
    Iterate next(body, direction, now.unknowns - step);
    ++result.evaluations;
    double share = 1;
    for (int k = 0; k < kMostHalvings && !is_last && !(next.residual.norm() < now.residual.norm()); ++k) {
      share /= 2;
      next = Iterate(body, direction, now.unknowns - share * step);
      ++result.evaluations;
    }
    now = next;
    if (!is_last) continue;
    result.reach = direction.dot(now.unknowns.head<3>());
    result.has_converged = std::abs(now.f.value) <= kOnSurface && now.unknowns[3] > 0;
    break;
  }
  return result;
}

}  // namespace literature
