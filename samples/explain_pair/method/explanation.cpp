#include "method/explanation.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "method/literature_path.hpp"

namespace explain_pair {

using supernormal::Solver;
using supernormal::Status;

Explanation explain(const Pair& pair, const supernormal::Settings& settings, Methods methods) {
  Explanation out{pair, {}, {}};
  for (const Solver solver : {Solver::Hybrid, Solver::Newton, Solver::FixedPoint}) {
    supernormal::Settings own = settings;
    own.solver = solver;
    if (is_solver_for(solver, pair)) out.paths.push_back(solver_path(pair, own));
  }
  if (out.answer().status == Status::InvalidInput || out.hybrid().evaluations.empty())
    throw std::runtime_error("\"" + pair.title + "\" has no answer: a pose or a shape has numbers that are not finite");
  if (methods == Methods::OfLiteratureToo) {
    for (SolverPath& path : literature_paths(pair, settings)) out.paths.push_back(std::move(path));
  }
  out.manifold =
      supernormal::find_contact_manifold(*pair.body1.shape, pair.body1.pose, *pair.body2.shape, pair.body2.pose, out.answer());
  return out;
}

std::span<const supernormal::ManifoldCorner> Explanation::corners() const {
  constexpr double kOnePoint = 0.01;
  double reach = 0;
  const std::span all(manifold.corners.data(), static_cast<std::size_t>(manifold.corner_count));
  for (const supernormal::ManifoldCorner& corner : all) reach = std::max(reach, (corner.point - answer().contact).norm());
  const double size = std::min(pair.body1.shape->half_extents().maxCoeff(), pair.body2.shape->half_extents().maxCoeff());
  return reach > kOnePoint * size ? all : all.first(0);
}

std::size_t Explanation::shown_evaluations() const {
  constexpr std::size_t kLeast = 8;
  const std::size_t own = std::max(kLeast, hybrid().evaluations.size());
  std::size_t most = 0;
  for (const SolverPath& path : paths) most = std::max(most, path.evaluations.size());
  return std::max(own, std::min(most, 2 * own));
}

double room_left(const SolverPath& path, std::size_t evaluations, double rolling_radius, const Vector3& n) {
  double best = -std::numeric_limits<double>::infinity(), least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < evaluations; ++k) {
    best = std::max(best, path.evaluations[k].s);
    least = std::min(least, n.dot(path.evaluations[k].cut));
  }
  return least - rolling_radius - best;
}

}  // namespace explain_pair
