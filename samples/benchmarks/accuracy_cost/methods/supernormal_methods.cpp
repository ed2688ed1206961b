#include "method.hpp"
#include "supernormal/proximity/solve.hpp"

namespace accuracy_cost {
namespace {

using supernormal::Proximity;
using supernormal::Settings;
using supernormal::Solver;
using supernormal::Status;

Answer::Kind kind_of(Status status) {
  // A stalled solver has an answer, too; its error is measured like any other.
  if (status == Status::Converged || status == Status::Stalled) return Answer::Kind::Gap;
  return status == Status::Apart ? Answer::Kind::Apart : Answer::Kind::None;
}

class OurSolver final : public Method {
 public:
  OurSolver(std::string name, const Settings& settings, Start start)
      : Method(std::move(name), power_of_ten(settings.tolerance)), settings_(settings), start_(start) {}

  Answer query(const Pair& pair) const override {
    const Proximity found = find_proximity(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2, settings_,
                                           start_ == Start::Warm ? &pair.warm_normal : nullptr);
    return {kind_of(found.status), found.gap, found.normal, static_cast<double>(found.evaluations), found.contact};
  }

 private:
  Settings settings_;
  Start start_;
};

}  // namespace

std::unique_ptr<Method> supernormal_method(std::string name, Solver solver, Start start, double tolerance) {
  Settings settings;
  settings.solver = solver;
  settings.tolerance = tolerance;
  return std::make_unique<OurSolver>(std::move(name), settings, start);
}

std::unique_ptr<Method> early_out(std::string name, Start start) {
  Settings settings;
  settings.stop_when_apart = true;
  return std::make_unique<OurSolver>(std::move(name), settings, start);
}

}  // namespace accuracy_cost
