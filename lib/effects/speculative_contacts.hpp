// Speculative contacts: contacts of bodies that do not touch yet.
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

  /// Turns the contacts `ahead` of one pair, which have negative depths, into constraints on the motion of the step: their gaps may
  /// close, or the bodies bounce. `may_approach`: whether the pair may be moved to touch first; a pair that touches elsewhere may
  /// not.
  void set_up(const PairMaterial& pair, Patch& ahead, bool may_approach);

  /// Moves the bodies with a planned displacement to touch, each body once a step.
  void approach();

  /// Drops the body's planned displacement.
  void remove(dBodyID body);

 private:
  /// m; of body 1 and of body 2.
  struct Displacements {
    Vector3 first = Vector3::Zero();
    Vector3 second = Vector3::Zero();
  };
  Displacements bring_to_touch(const dContact& first, double time, Patch& ahead);
  void plan(dBodyID body, const Vector3& displacement);
  void close_or_bounce(const PairMaterial& pair, Patch& ahead, bool may_approach);
  bool is_free(dBodyID body) const { return !displaced_.contains(body); }

  double step_;
  /// The planned displacement of a body until it touches.
  struct Approach {
    dBodyID body;
    Vector3 displacement;  // m
  };
  // ODE's spaces depend on the order in which their geoms were moved. The order must be the same in every run.
  std::vector<Approach> approaches_;
  std::unordered_set<dBodyID> displaced_;  // the bodies of `approaches_`
};

}  // namespace supernormal::effects
