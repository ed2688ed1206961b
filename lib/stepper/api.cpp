// The snStepper… functions.
#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "ode/geom/convert.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "stepper/stepper.hpp"
#include "supernormal/supernormal.h"

using supernormal::ode::guarded;
using supernormal::ode::require_not_null;
using supernormal::ode::succeeds;

struct snStepper : supernormal::stepper::Stepper {
  using Stepper::Stepper;
};

extern "C" snStepperID snStepperCreate(dWorldID world) {
  return guarded("snStepperCreate", snStepperID{}, [&] {
    require_not_null("world", world);
    return std::make_unique<snStepper>(world).release();
  });
}

extern "C" void snStepperDestroy(snStepperID stepper) { delete stepper; }

extern "C" int snStepperAddBody(snStepperID stepper, dBodyID body) {
  return succeeds("snStepperAddBody", [&] {
    require_not_null("stepper", stepper);
    require_not_null("body", body);
    stepper->add_body(body);
  });
}

extern "C" int snStepperRemoveBody(snStepperID stepper, dBodyID body) {
  return succeeds("snStepperRemoveBody", [&] {
    require_not_null("stepper", stepper);
    require_not_null("body", body);
    stepper->remove_body(body);
  });
}

extern "C" int snStepperAddContact(snStepperID stepper, const dContact* contact, dBodyID body1, dBodyID body2) {
  return succeeds("snStepperAddContact", [&] {
    require_not_null("stepper", stepper);
    require_not_null("contact", contact);
    stepper->add_contact(*contact, body1, body2);
  });
}

extern "C" dReal snStepperStep(snStepperID stepper, dReal step) {
  return guarded("snStepperStep", dReal(-1), [&] {
    require_not_null("stepper", stepper);
    const double done = stepper->step(step);
    return done == double{step} ? step : supernormal::ode::to_real(done);
  });
}

extern "C" int snStepperMoves(snStepperID stepper, dBodyID body) {
  return guarded("snStepperMoves", -1, [&] {
    require_not_null("stepper", stepper);
    require_not_null("body", body);
    return stepper->moves(body) ? 1 : 0;
  });
}

extern "C" int snStepperSetAccuracy(snStepperID stepper, dReal sag, int least, int most) {
  return succeeds("snStepperSetAccuracy", [&] {
    constexpr int kMostSubSteps = 1000000;
    require_not_null("stepper", stepper);
    supernormal::require_in("sag", sag, 1e-12, 1);
    supernormal::require_in("least", least, 1, kMostSubSteps);
    supernormal::require_in("most", most, least, kMostSubSteps);
    stepper->set_accuracy({sag, least, most});
  });
}

extern "C" int snStepperSave(snStepperID stepper, const dGeomID* geoms, int count, double* numbers, int room) {
  return guarded("snStepperSave", -1, [&] {
    require_not_null("stepper", stepper);
    supernormal::require_in("count", count, 0, std::numeric_limits<int>::max());
    const std::vector<double> saved = stepper->save({geoms, static_cast<std::size_t>(count)});
    const int size = static_cast<int>(saved.size());
    if (size <= room) std::ranges::copy(saved, numbers);
    return size;
  });
}

extern "C" int snStepperLoad(snStepperID stepper, const dGeomID* geoms, int count, const double* numbers, int size) {
  return succeeds("snStepperLoad", [&] {
    require_not_null("stepper", stepper);
    supernormal::require_in("count", count, 0, std::numeric_limits<int>::max());
    supernormal::require_in("size", size, 0, std::numeric_limits<int>::max());
    stepper->load({geoms, static_cast<std::size_t>(count)}, {numbers, static_cast<std::size_t>(size)});
  });
}

extern "C" int snStepperContactForce(snStepperID stepper, int contact, dVector3 force) {
  return succeeds("snStepperContactForce", [&] {
    require_not_null("stepper", stepper);
    require_not_null("force", force);
    supernormal::ode::from_vector(stepper->contact_force(contact), force);
  });
}
