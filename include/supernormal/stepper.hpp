/// @namespace supernormal::ode
/// C++ objects for the C interface.
///
///     supernormal::ode::Stepper stepper(world);                  // in place of dWorldQuickStep; throws what it refuses
///     stepper.add_body(body);                                    // each body that it moves
///     … in the near callback, in place of a contact joint:
///         stepper.add_contact(contact, dGeomGetBody(g1), dGeomGetBody(g2));   // catch there: ODE's spaces stay locked otherwise
///     for (double left = step; left > 0; left -= stepper.step(left)) dSpaceCollide(space, data, near_callback);
#pragma once

#include <ode/ode.h>

#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "supernormal/shapes/shape.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {

/// A step that remembers its contact forces (the snStepper… functions of supernormal.h). What they refuse is a
/// std::invalid_argument here, with the text of snLastError; it has then changed nothing.
class Stepper {
 public:
  /// For bodies of `world`, which must live longer and have no other stepper.
  explicit Stepper(dWorldID world) : handle_(accepted(snStepperCreate(world))) {}

  /// The stepper moves this body from now on. It must be of the world, and not be added yet.
  void add_body(dBodyID body) { accepted(snStepperAddBody(handle_.get(), body)); }

  /// The stepper leaves this body, and forgets its contacts. Call it before dBodyDestroy.
  void remove_body(dBodyID body) { accepted(snStepperRemoveBody(handle_.get(), body)); }

  /// For the next step, in place of a contact joint. A depth < 0 is a gap; do not call snContactLookAhead. The bodies are bodies of
  /// the stepper; one may be null, the world. Contacts of the same two geoms are added one after the other.
  void add_contact(const dContact& contact, dBodyID body1, dBodyID body2) {
    accepted(snStepperAddContact(handle_.get(), &contact, body1, body2));
  }

  /// Moves the bodies by `time` (s, > 0) and forgets the contacts. Returns the time done, s: less than `time` if bodies have left
  /// the paths for which their contacts were found. Then collide again, and step by the rest.
  dReal step(dReal time) {
    const dReal done = snStepperStep(handle_.get(), time);
    accepted(done > 0);
    return done;
  }

  /// Whether the stepper moved this body of its in the last step. Otherwise dWorldQuickStep did: a joint holds it, or one that it
  /// is joined to or touches, that the stepper does not solve.
  bool moves(dBodyID body) const {
    const int moved = snStepperMoves(handle_.get(), body);
    accepted(moved >= 0);
    return moved == 1;
  }

  /// sag: the largest overlap of a contact at rest, relative to the least radius of gyration of its bodies, in [1e-12, 1]. least
  /// and most: sub-steps of a step, in [1, 1000000].
  void set_accuracy(dReal sag = dReal(2e-3), int least = 8, int most = 64) {
    accepted(snStepperSetAccuracy(handle_.get(), sag, least, most));
  }

  /// N; on body 1, the mean over the last step. The contacts have the numbers 0, 1, … in the order in which they were added.
  Vector3 contact_force(int contact) const {
    dVector3 force;
    accepted(snStepperContactForce(handle_.get(), contact, force));
    return {force[0], force[1], force[2]};
  }

  /// Between two whole steps: what it remembers, with the places of geoms in `geoms` (snStepperSave).
  std::vector<double> save(std::span<const dGeomID> geoms) const {
    const auto write = [&](std::span<double> numbers) {
      const int size = snStepperSave(handle_.get(), geoms.data(), int(geoms.size()), numbers.data(), int(numbers.size()));
      accepted(size >= 0);
      return static_cast<std::size_t>(size);
    };
    std::vector<double> numbers(write({}));
    write(numbers);
    return numbers;
  }

  /// Gives a new stepper what save() of another one returned, whose geoms had the same places.
  void load(std::span<const dGeomID> geoms, std::span<const double> numbers) {
    accepted(snStepperLoad(handle_.get(), geoms.data(), int(geoms.size()), numbers.data(), int(numbers.size())));
  }

 private:
  struct Destroy {
    void operator()(snStepperID stepper) const { snStepperDestroy(stepper); }
  };
  template <typename Result>
  static Result accepted(Result result) {
    if (result == Result{}) throw std::invalid_argument(snLastError());
    return result;
  }

  std::unique_ptr<snStepper, Destroy> handle_;
};

}  // namespace supernormal::ode
