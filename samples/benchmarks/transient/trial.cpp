#include "trial.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
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

constexpr double kWrong = 1e-6;   // of the smallest half-axis of the pair
constexpr double kParted = 0.01;  // smallest half-axes

/// The last answer's normal of each pair whose bounding boxes meet, in the frame of body 1.
using Memory = std::map<Neighbours, std::optional<Vector3>>;

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void judge(const Pair& pair, const Answer& answer, const supernormal::Proximity& truth, Outcome& outcome) {
  const double accuracy = kWrong * pair.size;
  const bool has_contact = answer.kind == Answer::Kind::Gap && answer.gap < 0;
  if (!truth.is_global) {
    ++outcome.undecided;
  } else if (answer.kind == Answer::Kind::None) {
    // counted as a failure
  } else if (truth.gap < -accuracy && !has_contact) {
    ++outcome.missed;
  } else if (truth.gap > accuracy && has_contact) {
    ++outcome.invented;
  } else if (has_contact && !(std::abs(answer.gap - truth.gap) <= accuracy)) {
    ++outcome.wrong;
  }
}

Touch touch_of(const Answer& answer) {
  Touch touch;
  if (answer.kind != Answer::Kind::Gap || !(answer.gap < 0)) return touch;
  // The world gets only valid contacts.
  if (!answer.contact || !answer.contact->allFinite() || !(std::abs(answer.normal.squaredNorm() - 1) < 1e-6)) return touch;
  return {true, -answer.gap, answer.normal, *answer.contact};
}

/// The pairs of a step and the method's answers.
class Step {
 public:
  Step(Throw& world, const Contestant& contestant, Memory& memory, Outcome& outcome) : contestant_(contestant), outcome_(outcome) {
    Memory current;
    for (const Neighbours& key : world.neighbours()) {
      const auto& [body1, body2] = key;
      const auto known = memory.find(key);
      Pair pair{accuracy_cost::BodyClass::Ellipsoid,
                accuracy_cost::Situation::Touching,
                world.shape(body1),
                world.shape(body2),
                world.pose(body1),
                world.pose(body2),
                0,
                0,
                {},
                {},
                {}};
      pair.size = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
      // The preparation of a body, made once, is not timed.
      if (known == memory.end()) contestant.cold->query(pair);
      const std::optional<Vector3> normal = known == memory.end() ? std::nullopt : known->second;
      if (normal) pair.warm_normal = *normal;
      is_warm_.push_back(contestant.warm != nullptr && normal.has_value());
      pairs_.push_back(std::move(pair));
      keys_.push_back(key);
      current.emplace(key, normal);
    }
    memory.swap(current);
    answers_.resize(pairs_.size());
    const double start = processor_time();
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Method& method = is_warm_[k] ? *contestant_.warm : *contestant_.cold;
      answers_[k] = method.query(pairs_[k]);
    }
    outcome_.seconds += processor_time() - start;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Answer& answer = answers_[k];
      ++outcome_.queries;
      if (answer.kind == Answer::Kind::None) ++outcome_.failed;
      outcome_.evaluations += answer.evaluations;
      std::optional<Vector3>& normal = memory[keys_[k]];
      normal.reset();
      if (answer.kind == Answer::Kind::Gap && std::abs(answer.normal.squaredNorm() - 1) < 1e-6) {
        normal = (pairs_[k].pose1.rotation.transpose() * answer.normal).normalized();
      }
    }
  }

  /// Compares all answers with the certified ones, and returns the certified contacts.
  std::vector<Touch> certified_touches() const {
    std::vector<Touch> touches;
    touches.reserve(pairs_.size());
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const supernormal::Proximity truth = certified_proximity(pairs_[k]);
      judge(pairs_[k], answers_[k], truth, outcome_);
      touches.push_back({truth.gap < 0, -truth.gap, truth.normal, truth.contact});
    }
    return touches;
  }

  std::vector<Touch> touches() const {
    std::vector<Touch> touches;
    touches.reserve(answers_.size());
    for (const Answer& answer : answers_) touches.push_back(touch_of(answer));
    return touches;
  }

 private:
  const Contestant& contestant_;
  Outcome& outcome_;
  std::vector<Pair> pairs_;
  std::vector<Neighbours> keys_;
  std::vector<bool> is_warm_;
  std::vector<Answer> answers_;
};

/// The largest distance of a body from its position in the certified world, in its smallest half-axes.
double distance(const Throw& world, const std::vector<Vector3>& positions) {
  double largest = 0;
  for (std::size_t body = 0; body < world.bodies(); ++body) {
    const double size = world.shape(body)->half_extents().minCoeff();
    const double relative = (world.position(body) - positions[body]).norm() / size;
    if (!(relative <= largest)) largest = relative;
  }
  return largest;
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

Outcome watch(const Trial& trial, const Contestant& contestant) {
  Throw world(trial.setup, false);
  Outcome outcome;
  Memory memory;
  const int steps = static_cast<int>(std::lround(trial.duration / trial.setup.step));
  for (int k = 0; k < steps; ++k) world.step(Step(world, contestant, memory, outcome).certified_touches());
  return outcome;
}

Outcome run(const Trial& trial, const Contestant& contestant, bool is_disturbed, const Path* certified, Path* path) {
  Throw world(trial.setup, is_disturbed);
  Outcome outcome;
  Memory memory;
  const int steps = static_cast<int>(std::lround(trial.duration / trial.setup.step));
  for (int k = 0; k < steps; ++k) {
    const Step step(world, contestant, memory, outcome);
    world.step(step.touches());
    const auto index = static_cast<std::size_t>(k);
    if (certified != nullptr) {
      outcome.distances.push_back(distance(world, (*certified)[index]));
      if (std::isinf(outcome.parted) && !(outcome.distances.back() <= kParted)) outcome.parted = (k + 1) * trial.setup.step;
    }
    if (path == nullptr) continue;
    std::vector<Vector3> positions(world.bodies());
    for (std::size_t body = 0; body < world.bodies(); ++body) positions[body] = world.position(body);
    path->push_back(std::move(positions));
  }
  return outcome;
}

}  // namespace transient
