// snGeomProximity and snGeomProximityCertified.
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "ode/colliders/collider.hpp"
#include "ode/colliders/no_answer.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

// The core's result for two geoms, ours first.
Proximity query(dGeomID ours, dGeomID collider, Goal goal) {
  require_body(ours);
  PairQuery* const pair_query = find_query(dGeomGetClass(collider));
  if (pair_query == nullptr) {
    throw std::invalid_argument(
        "the collider is " + geom_class_name(collider) +
        ", but must be a body made by snCreate… or one of ODE's own geoms (not a space, not a dGeomTransform)");
  }
  Proximity result = pair_query(ours, collider, goal).deepest;
  if (result.status == Status::InvalidInput || !std::isfinite(result.gap)) {
    refuse_pair(ours, collider);
  }
  return result;
}

void write(const Proximity& proximity, bool swapped, snProximity& out) {
  out.gap = to_real(proximity.gap);
  out.error = to_real(proximity.error);
  from_vector(swapped ? Vector3(-proximity.normal) : proximity.normal, out.normal);
  from_vector(swapped ? proximity.point2 : proximity.point1, out.point1);
  from_vector(swapped ? proximity.point1 : proximity.point2, out.point2);
  out.normal[3] = out.point1[3] = out.point2[3] = 0;
  out.evaluations = proximity.evaluations;
  out.converged = proximity.status == Status::Converged ? 1 : 0;
  out.is_global = proximity.is_global ? 1 : 0;
}

int answer_query(const char* function, dGeomID g1, dGeomID g2, Goal goal, snProximity* out) {
  return guarded(function, 0, [&] {
    require_not_null("g1", g1);
    require_not_null("g2", g2);
    require_not_null("out", out);
    if (g1 == g2) throw std::invalid_argument("g1 and g2 are the same geom, but must be two");
    const bool swapped = find_body(g1) == nullptr;
    write(swapped ? query(g2, g1, goal) : query(g1, g2, goal), swapped, *out);
    return 1;
  });
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snGeomProximity(dGeomID g1, dGeomID g2, snProximity* out) {
  return answer_query("snGeomProximity", g1, g2, Goal::Distance, out);
}

extern "C" int snGeomProximityCertified(dGeomID g1, dGeomID g2, snProximity* out) {
  return answer_query("snGeomProximityCertified", g1, g2, Goal::CertifiedDistance, out);
}
