#include <cmath>

#include "method.hpp"
#include "supernormal/proximity/gap_function.hpp"
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

class Evaluations final : public Method {
 public:
  explicit Evaluations(supernormal::Order order)
      : Method(order == supernormal::Order::Point ? kPointCost : kCurvatureCost), order_(order) {}

  Answer query(const Pair& pair) const override {
    supernormal::GapFunction gap(*pair.shape1, pair.pose1, *pair.shape2, pair.pose2);
    supernormal::GapJet jet;
    Answer answer;
    for (const supernormal::Vector3& n : pair.normals) {
      gap.evaluate(n, order_, jet);
      answer.gap += jet.s;
    }
    answer.evaluations = gap.evaluations();
    return answer;
  }

 private:
  supernormal::Order order_;
};

class Floor final : public Method {
 public:
  Floor() : Method(kFloorCost) {}

  Answer query(const Pair& pair) const override {
    Answer answer;
    for (const supernormal::Vector3& n : pair.normals) {
      const double x = std::abs(n.x()) + 0.01;
      for (int k = 0; k < kPowers; ++k) answer.gap += std::exp(1.5 * std::log(x + 0.1 * k));
    }
    answer.evaluations = kNormalsPerPair;
    return answer;
  }

 private:
  static constexpr int kPowers = 8;  // two bodies have two norms each
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

std::unique_ptr<Method> floor_cost() { return std::make_unique<Floor>(); }

std::unique_ptr<Method> evaluation_cost(supernormal::Order order) { return std::make_unique<Evaluations>(order); }

}  // namespace accuracy_cost
