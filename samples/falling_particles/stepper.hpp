#pragma once

#include <ode/ode.h>

#include <span>
#include <vector>

#include "scene.hpp"
#include "stopwatch.hpp"
#include "world.hpp"

namespace falling_particles {

/// Where the time of the steps went, and how much was done in them.
struct StepCosts {
  Stopwatch collision;      ///< dSpaceCollide: broad and narrow phase
  Stopwatch narrow_phase;   ///< dCollide, within collision
  Stopwatch contact_setup;  ///< effects' passes, contact joints made and removed
  Stopwatch solver;         ///< dWorldQuickStep
  unsigned long long pairs_tested = 0;
  unsigned long long contacts = 0;
  double broad_phase_seconds() const { return collision.seconds() - narrow_phase.seconds(); }
};

/// Advances a world: find contacts, turn them into constraints, step.
class Stepper {
 public:
  Stepper(const World& world, const Scene& scene);
  ~Stepper();
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  void step();

  std::size_t contacts() const { return contacts_.size(); }    ///< of the last step
  double deepest_contact() const { return deepest_contact_; }  ///< m, of all steps
  const StepCosts& costs() const { return costs_; }

 private:
  static void near_callback(void* self, dGeomID g1, dGeomID g2);
  /// Of scenes whose bodies may sleep: leaves pairs alone of which neither is awake.
  static void near_callback_of_sleepers(void* self, dGeomID g1, dGeomID g2);
  void collide(dGeomID g1, dGeomID g2);
  void attach(std::span<const dContactGeom> pair);

  const World& world_;
  double step_;
  dNearCallback* near_callback_;
  dJointGroupID joints_;
  std::vector<dContactGeom> contacts_;
  double deepest_contact_ = 0;
  StepCosts costs_;
};

}  // namespace falling_particles
