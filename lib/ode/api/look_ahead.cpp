// Contacts before overlap.
#include "ode/geom/look_ahead.hpp"

#include "ode/geom/body.hpp"
#include "ode/geom/bounce.hpp"
#include "ode/geom/bounding_box.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

// Longest look-ahead time, s: far beyond any step, and short enough to keep displacements finite.
constexpr double kLongestTime = 1e6;

double require_time(double time) { return require_in("time", time, 0, kLongestTime, "s"); }

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snGeomSetLookAhead(dGeomID geom, dReal time) {
  return succeeds("snGeomSetLookAhead", [&] {
    Body& body = require_body(geom);
    body.set_look_ahead(require_time(time));
    set_moved(geom);  // the bounding box changes
  });
}

extern "C" int snSetDefaultLookAhead(dReal time) {
  return succeeds("snSetDefaultLookAhead", [&] { set_default_look_ahead(require_time(time)); });
}

extern "C" void snContactLookAhead(dContact* contact, dReal step) {
  succeeds("snContactLookAhead", [&] {
    require_not_null("contact", contact);
    const double duration = require_positive("step", step, "s");
    const bool is_ahead = looks_ahead(contact->geom);
    if (is_ahead || contact->geom.depth < 0) let_close_or_bounce(*contact, duration);
    if (is_ahead) correct_leftover(contact->surface);
  });
}
