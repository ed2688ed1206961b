#include "contestant.hpp"

#include <utility>

#include "literature/method.hpp"
#include "supernormal/proximity/solve.hpp"

namespace transient {
namespace {

using accuracy_cost::Answer;
using accuracy_cost::Method;
using accuracy_cost::Methods;
using accuracy_cost::Pair;
using accuracy_cost::Start;
using supernormal::Proximity;
using supernormal::Solver;

constexpr double kTolerance = 1e-9;  // the tolerance of all methods that have one
constexpr double kFinest = 1e-14;
constexpr double kCertifiedTolerance = 1e-14;

class Certified final : public Method {
 public:
  Certified() : Method(kCertified) {}

  Answer query(const Pair& pair) const override {
    const Proximity found = certified_proximity(pair);
    return {Answer::Kind::Gap, found.gap, found.normal, static_cast<double>(found.evaluations), found.contact};
  }
};

void add_ours(std::vector<Contestant>& all, const char* name, Solver solver, double tolerance = kTolerance) {
  all.push_back({name, "cold", accuracy_cost::supernormal_method(name, solver, Start::Cold, tolerance), nullptr});
  all.push_back({name, "warm", accuracy_cost::supernormal_method(name, solver, Start::Cold, tolerance),
                 accuracy_cost::supernormal_method(name, solver, Start::Warm, tolerance)});
}

/// The name of a method in a list includes the number of vertices if the methods differ by it.
void add_cold(std::vector<Contestant>& all, Methods methods, bool has_sizes) {
  for (auto& method : methods) {
    const std::string name = has_sizes ? method->name() + " (" + method->accuracy() + " vertices)" : method->name();
    all.push_back({name, "cold", std::move(method), nullptr});
  }
}

}  // namespace

Proximity certified_proximity(const Pair& pair) {
  supernormal::Settings settings;
  settings.tolerance = kCertifiedTolerance;
  settings.certify_depth = true;
  return find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, settings);
}

std::vector<Contestant> contestants() {
  std::vector<Contestant> all;
  all.push_back({kCertified, "cold", std::make_unique<Certified>(), nullptr});
  add_ours(all, "hybrid", Solver::Hybrid);
  add_ours(all, "hybrid at 1e-14", Solver::Hybrid, kFinest);
  add_ours(all, "Newton (Algorithm I)", Solver::Newton);
  add_ours(all, "fixed point (Algorithm II)", Solver::FixedPoint);
  add_cold(all, accuracy_cost::literature_methods(Start::Cold, kTolerance), false);
  Methods cold = accuracy_cost::literature_methods(Start::Cold, kTolerance);
  Methods warm = accuracy_cost::literature_methods(Start::Warm, kTolerance);
  for (std::size_t k = 0; k < cold.size(); ++k) {
    const std::string name = cold[k]->name();
    all.push_back({name, "warm", std::move(cold[k]), std::move(warm[k])});
  }
  add_cold(all, accuracy_cost::libccd_methods(), false);
  add_cold(all, accuracy_cost::bullet_methods(), false);
  add_cold(all, accuracy_cost::literature_mesh_methods(accuracy_cost::Motion::Moves), true);
  return all;
}

}  // namespace transient
