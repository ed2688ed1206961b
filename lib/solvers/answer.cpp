#include "solvers/answer.hpp"

#include <algorithm>
#include <limits>

namespace supernormal {

double absolute_tolerance(const GapFunction& gap, const Settings& settings) {
  return std::max(settings.tolerance * gap.length_unit() - gap.rounding(), gap.rounding());
}

Proximity answer(const GapFunction& gap, const GapJet& jet, double model_error, Status status) {
  Proximity out;
  out.gap = jet.s;
  out.normal = jet.n;
  out.point1 = jet.jet1.r;
  out.point2 = jet.jet1.r + jet.d;
  out.contact = 0.5 * (out.point1 + out.point2);
  out.evaluations = gap.evaluations();
  out.status = status;
  // Two points of separated bodies are never closer than the gap.
  const double witness_error = jet.s > 0 ? jet.d.norm() - jet.s : std::numeric_limits<double>::infinity();
  if (status == Status::Apart || status == Status::Diverged) model_error = std::numeric_limits<double>::infinity();
  out.error = std::min(model_error, witness_error) + gap.rounding();
  return out;
}

}  // namespace supernormal
