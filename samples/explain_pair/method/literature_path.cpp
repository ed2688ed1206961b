#include "method/literature_path.hpp"

#include <cmath>
#include <utility>

#include "literature/method.hpp"

namespace explain_pair {
namespace {

constexpr double kUnit = 1e-9;  // far above rounding; an iterate without a normal has zero or NaN

supernormal::Status status_of(literature::Outcome outcome) {
  switch (outcome) {
    case literature::Outcome::Found:
      return supernormal::Status::Converged;
    case literature::Outcome::Apart:
      return supernormal::Status::Apart;
    case literature::Outcome::Failed:
      break;
  }
  return supernormal::Status::Diverged;
}

}  // namespace

std::vector<SolverPath> literature_paths(const Pair& pair, const supernormal::Settings& settings) {
  const PlacedBody &body1 = pair.body1, &body2 = pair.body2;
  if (!literature::Superquadric::of(*body1.shape) || !literature::Superquadric::of(*body2.shape)) return {};
  const literature::Bodies bodies(*body1.shape, body1.pose, *body2.shape, body2.pose);
  WorldGap gap(pair);
  std::vector<SolverPath> paths;
  for (const auto& [name, solve] : literature::methods()) {
    std::vector<Vector3> normals;
    const literature::CommonNormal found = solve(
        bodies,
        {.tolerance = settings.tolerance, .first_normal = pair.first_normal ? &*pair.first_normal : nullptr, .path = &normals});
    SolverPath path{name, std::nullopt, {}, {}, {}};
    for (const Vector3& n : normals) {
      if (!(std::abs(n.squaredNorm() - 1) <= kUnit)) break;  // the method left its domain
      path.evaluations.push_back(gap.evaluate_in_body1(n));
    }
    if (path.evaluations.empty()) continue;
    path.answer.status = status_of(found.outcome);
    // A method that does not compute the gap ends at its last normal.
    path.answer.gap = found.outcome == literature::Outcome::Found ? found.gap : path.evaluations.back().s;
    path.answer.normal = body1.pose.rotation * found.normal;
    path.answer.evaluations = found.evaluations;
    paths.push_back(std::move(path));
  }
  return paths;
}

}  // namespace explain_pair
