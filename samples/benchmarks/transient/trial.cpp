#include "trial.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>

namespace transient {
namespace {

using accuracy_cost::Answer;
using accuracy_cost::Method;
using accuracy_cost::Pair;

constexpr double kWrong = 1e-6;   // of the smallest half-axis of the pair
constexpr double kParted = 0.01;  // smallest half-axes

using Key = std::pair<std::size_t, std::size_t>;

/// The record of a pair while its bounding boxes meet.
struct Memory {
  std::optional<Vector3> normal;  ///< the last answer's, in the frame of body 1
};

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void judge(const Pair& pair, const Answer& answer, const supernormal::Proximity& truth, Outcome& outcome) {
  ++outcome.judged;
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
  Step(Throw& world, const Contestant& contestant, std::map<Key, Memory>& memories, Outcome& outcome)
      : contestant_(contestant), outcome_(outcome) {
    std::map<Key, Memory> current;
    for (const auto& [body1, body2] : world.neighbours()) {
      const Key key(body1, body2);
      const auto known = memories.find(key);
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
                {},
                {}};
      pair.size = std::min(pair.shape1->half_extents().minCoeff(), pair.shape2->half_extents().minCoeff());
      // The preparation of a body, made once, is not timed.
      if (known == memories.end()) contestant.cold->query(pair);
      const Memory memory = known == memories.end() ? Memory() : known->second;
      if (memory.normal) pair.warm_normal = *memory.normal;
      is_warm_.push_back(contestant.warm != nullptr && memory.normal.has_value());
      pairs_.push_back(std::move(pair));
      keys_.push_back(key);
      current.emplace(key, memory);
    }
    memories.swap(current);
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
      if (is_warm_[k]) ++outcome_.warm_queries;
      if (answer.kind == Answer::Kind::None) ++outcome_.failed;
      outcome_.evaluations += answer.evaluations;
      std::optional<Vector3>& normal = memories[keys_[k]].normal;
      normal.reset();
      if (answer.kind == Answer::Kind::Gap && std::abs(answer.normal.squaredNorm() - 1) < 1e-6) {
        normal = (pairs_[k].pose1.rotation.transpose() * answer.normal).normalized();
      }
    }
  }

  void judge_all() const {
    for (std::size_t k = 0; k < pairs_.size(); ++k) judge(pairs_[k], answers_[k], certified_proximity(pairs_[k]), outcome_);
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
  std::vector<Key> keys_;
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

Outcome watch(const Trial& trial, const Contestant& contestant) {
  Throw world(trial.setup, false);
  Outcome outcome;
  std::map<Key, Memory> memories;
  const int steps = static_cast<int>(std::lround(trial.duration / trial.setup.step));
  for (int k = 0; k < steps; ++k) world.step(Step(world, contestant, memories, outcome).certified_touches());
  return outcome;
}

Outcome run(const Trial& trial, const Contestant& contestant, bool is_disturbed, const Path* certified, Path* path) {
  Throw world(trial.setup, is_disturbed);
  Outcome outcome;
  std::map<Key, Memory> memories;
  const int steps = static_cast<int>(std::lround(trial.duration / trial.setup.step));
  const int between = std::max(1, (steps + trial.judged_steps - 1) / std::max(1, trial.judged_steps));
  const double energy = world.kinetic_energy();
  for (int k = 0; k < steps; ++k) {
    const Step step(world, contestant, memories, outcome);
    if (trial.judged_steps > 0 && k % between == 0) step.judge_all();
    world.step(step.touches());
    if (!trial.setup.has_friction) {
      outcome.energy_drift = std::max(outcome.energy_drift, std::abs(world.kinetic_energy() / energy - 1));
    }
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
  outcome.momentum_drift = world.momentum_drift() / world.momentum_scale();
  return outcome;
}

}  // namespace transient
