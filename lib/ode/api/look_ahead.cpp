// Contacts before overlap.
#include "ode/geom/look_ahead.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "ode/geom/body.hpp"
#include "ode/geom/moved.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

// Longest look-ahead time, s: far beyond any step, and short enough to keep displacements finite.
constexpr double kLongestTime = 1e6;

double require_time(double time) { return require_in("time", time, 0, kLongestTime, "s"); }

/// Lets the contact close its gap within one step. A normal velocity of the surface (motionN) is added.
void to_motion_constraint(dContact& contact, double step) {
  if (!(contact.geom.depth < 0)) return;
  const double of_surface = (contact.surface.mode & dContactMotionN) != 0 ? double{contact.surface.motionN} : 0;
  const double motion = of_surface + double{contact.geom.depth} / step;
  const auto largest = double{std::numeric_limits<dReal>::max()};
  if (!(std::abs(motion) <= largest)) {
    throw std::invalid_argument("step = " + to_text(step) + " s closes the gap of " + to_text(-double{contact.geom.depth}) +
                                " m with " + to_text(-motion) + " m/s, but motionN must be within " + to_text(largest) + " m/s");
  }
  contact.surface.motionN = static_cast<dReal>(motion);
  contact.surface.mode |= dContactMotionN;
  contact.geom.depth = 0;
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snGeomSetLookAhead(dGeomID geom, dReal time) {
  return guarded("snGeomSetLookAhead", 0, [&] {
    Body& body = require_body(geom);
    body.set_look_ahead(require_time(time));
    set_moved(geom);  // the bounding box changes
    return 1;
  });
}

extern "C" int snSetDefaultLookAhead(dReal time) {
  return guarded("snSetDefaultLookAhead", 0, [&] {
    set_default_look_ahead(require_time(time));
    return 1;
  });
}

extern "C" void snContactLookAhead(dContact* contact, dReal step) {
  guarded("snContactLookAhead", 0, [&] {
    require_not_null("contact", contact);
    to_motion_constraint(*contact, require_positive("step", step, "s"));
    if (looks_ahead(contact->geom)) correct_leftover(contact->surface);
    return 1;
  });
}
