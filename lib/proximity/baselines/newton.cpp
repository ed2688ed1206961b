#include <cmath>

#include "proximity/answer.hpp"
#include "proximity/local/local_model.hpp"
#include "proximity/solvers.hpp"
#include "shapes/finite.hpp"

namespace supernormal {
namespace {

// The predicted gain is half the slope times the step. This factor allows for the change of the Hessian over the step.
constexpr double kHessianChange = 2;

Proximity answer_with_contact(GapFunction& gap, const Settings& settings, const GapJet& jet, double error, Status status) {
  Proximity out = answer(gap, settings, jet, error, status);
  place_contact(gap, settings, jet, out);
  return out;
}

}  // namespace

Proximity solve_newton(GapFunction& gap, const Settings& settings, const Vector3& start) {
  const double tolerance = absolute_tolerance(gap, settings);
  GapJet jet;
  Vector3 n = start;
  while (true) {
    gap.evaluate(n, Order::Hessian, jet);
    if (settings.stop_when_apart && jet.s > 0) return answer_with_contact(gap, settings, jet, 0, Status::Apart);

    // The step makes both tangential components of d zero. It may lead to any kind of stationary point.
    const LocalModel local = LocalModel::of(gap, jet);
    const Vector2 step = local.model.A.solve(local.model.g);
    if (!all_finite(step))
      return answer_with_contact(gap, settings, jet, 0, local.model.g.norm() == 0 ? Status::Converged : Status::Diverged);
    const double error = kHessianChange * 0.5 * std::abs(local.model.g.dot(step));
    if (error <= tolerance)
      return answer_with_contact(gap, settings, jet, error,
                                 std::isfinite(local.model.largest_gain()) ? Status::Converged : Status::Diverged);
    if (gap.evaluations() >= settings.max_evaluations)
      return answer_with_contact(gap, settings, jet, error, Status::EvaluationLimit);
    n = (n + local.plane1.lift(step)).normalized();
  }
}

}  // namespace supernormal
