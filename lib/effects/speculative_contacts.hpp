// Contacts ahead of touch.
#pragma once

#include <ode/ode.h>

#include <span>
#include <unordered_set>
#include <vector>

#include "effects/pair_material.hpp"

namespace supernormal::effects {

class SpeculativeSetup {
 public:
  /// `step`: s.
  explicit SpeculativeSetup(double step) : step_(step) {}

  /// Makes the contacts `ahead` of one pair, of negative depth, constraints on the motion of the step: their gaps may close, or the
  /// bodies bounce. `may_approach`: whether the pair may be brought to touch first, as one that touches elsewhere may not.
  void set_up(const PairMaterial& pair, Patch& ahead, bool may_approach);

  /// Brings the pairs to touch that will bounce, each body once a step.
  void approach();

  /// Forgets a body.
  void remove(dBodyID body);

 private:
  /// m, of body 1 and of body 2.
  struct Ways {
    Vector3 first = Vector3::Zero();
    Vector3 second = Vector3::Zero();
  };
  Ways bring_to_touch(const dContact& first, double time, Patch& ahead);
  void plan(dBodyID body, const Vector3& way);
  void close_or_bounce(const PairMaterial& pair, Patch& ahead, bool may_approach);
  bool is_free(dBodyID body) const { return !on_their_way_.contains(body); }

  double step_;
  /// Of a body until it touches.
  struct Approach {
    dBodyID body;
    Vector3 way;  // m
  };
  // Spaces of ODE depend on the order in which their geoms were moved: it must be the same in every run.
  std::vector<Approach> approaches_;
  std::unordered_set<dBodyID> on_their_way_;  // their bodies
};

}  // namespace supernormal::effects
