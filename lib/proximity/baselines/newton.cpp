#include <cmath>

#include "base/finite.hpp"
#include "proximity/local/local_model.hpp"
#include "proximity/search/answer.hpp"
#include "proximity/search/solvers.hpp"

namespace supernormal {
namespace {

// The predicted gain is half the slope times the step. This factor allows for the change of the Hessian over the step.
constexpr double kHessianChange = 2;

Proximity answer_with_contact(GapFunction& gap, const StoppingRule& rule, const GapJet& jet, double error, Status status) {
  Proximity out = answer(gap, rule, jet, error, status);
  place_contact(gap, rule, jet, out);
  return out;
}

}  // namespace

Proximity solve_newton(GapFunction& gap, const Settings& settings, const Vector3& start) {
  const StoppingRule rule(gap, settings);
  GapJet jet;
  Vector3 n = start;
  while (true) {
    gap.evaluate(n, Order::Hessian, jet);
    if (rule.is_apart(jet)) return answer_with_contact(gap, rule, jet, 0, Status::Apart);

    // The step makes both tangential components of d zero. It may lead to any kind of stationary point.
    const LocalModel local = LocalModel::of(gap, jet);
    const Vector2 step = local.model.A.solve(local.model.g);
    if (!all_finite(step))
      return answer_with_contact(gap, rule, jet, 0, local.model.g.norm() == 0 ? Status::Converged : Status::Diverged);
    const double error = kHessianChange * 0.5 * std::abs(local.model.g.dot(step));
    if (rule.allows(error))
      return answer_with_contact(gap, rule, jet, error,
                                 std::isfinite(local.model.largest_gain()) ? Status::Converged : Status::Diverged);
    if (!rule.may_evaluate()) return answer_with_contact(gap, rule, jet, error, Status::EvaluationLimit);
    n = (n + local.plane1.lift(step)).normalized();
  }
}

}  // namespace supernormal
