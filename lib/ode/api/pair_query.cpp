// snGeomProximity, snGeomProximityCertified and snGeomTimeOfImpact.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "ode/api/two_geoms.hpp"
#include "ode/colliders/collider.hpp"
#include "ode/colliders/impact.hpp"
#include "ode/colliders/no_answer.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

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

void write(const Impact& impact, bool swapped, snImpact& out) {
  const Proximity& then = impact.proximity;
  out.time = to_real(impact.time);
  out.hits = impact.may_hit() ? 1 : 0;
  from_vector(swapped ? Vector3(-then.normal) : then.normal, out.normal);
  // Where faces touch, the witness points are not unique. The contact point lies in both bodies.
  const Vector3 half = 0.5 * then.gap * then.normal;
  const Vector3 point1 = impact.may_hit() ? Vector3(then.contact - half) : then.point1;
  const Vector3 point2 = impact.may_hit() ? Vector3(then.contact + half) : then.point2;
  from_vector(swapped ? point2 : point1, out.point1);
  from_vector(swapped ? point1 : point2, out.point2);
  out.normal[3] = out.point1[3] = out.point2[3] = 0;
  out.evaluations = impact.evaluations;
  out.converged = impact.status == ImpactStatus::NotConverged ? 0 : 1;
}

/// The names are for messages.
void require_velocities_in_range(dGeomID geom, const char* linear, const char* angular, double horizon) {
  const dBodyID body = dGeomGetBody(geom);
  if (body == nullptr) return;
  const double max_angular_speed = kMaxMotion / std::max(1.0, horizon);  // the angle of rotation must be in range, too
  for (int axis = 0; axis < 3; ++axis) {
    require_in(linear, dBodyGetLinearVel(body)[axis], -kMaxMotion, kMaxMotion, "m/s");
    require_in(angular, dBodyGetAngularVel(body)[axis], -max_angular_speed, max_angular_speed, "rad/s");
  }
}

int answer_query(const char* function, dGeomID g1, dGeomID g2, QueryKind kind, snProximity* out) {
  return guarded(function, 0, [&] {
    const TwoGeoms geoms(g1, g2, out);
    write(find_proximity_of(geoms, kind), geoms.is_swapped, *out);
    return 1;
  });
}

int answer_impact(dGeomID g1, dGeomID g2, double horizon, snImpact* out) {
  return guarded("snGeomTimeOfImpact", 0, [&] {
    const TwoGeoms geoms(g1, g2, out);
    require_supported(geoms);
    require_in("horizon", horizon, 0, kMaxHorizon, "s");
    require_velocities_in_range(g1, "linear velocity of g1", "angular velocity of g1", horizon);
    require_velocities_in_range(g2, "linear velocity of g2", "angular velocity of g2", horizon);
    const Impact impact = find_impact(geoms.ours, geoms.collider, horizon);
    if (impact.status == ImpactStatus::InvalidInput) geoms.refuse();
    write(impact, geoms.is_swapped, *out);
    return 1;
  });
}

}  // namespace

TwoGeoms::TwoGeoms(dGeomID g1, dGeomID g2, const void* out) : ours(g1), collider(g2) {
  require_not_null("g1", g1);
  require_not_null("g2", g2);
  require_not_null("out", out);
  if (g1 == g2) throw std::invalid_argument("g1 and g2 are the same geom, but must be two");
  is_swapped = find_body(g1) == nullptr;
  if (!is_swapped) return;
  std::swap(ours, collider);
  if (find_body(ours) != nullptr) return;
  throw std::invalid_argument("g1 is " + geom_class_name(g1) + " and g2 is " + geom_class_name(g2) +
                              ", but one of them must be a body made by snCreate…");
}

void TwoGeoms::refuse() const { refuse_pair(ours, collider, our_name(), collider_name()); }

void require_supported(const TwoGeoms& geoms) {
  const int number = dGeomGetClass(geoms.collider);
  if (find_query(number) == nullptr) refuse_class(geoms.collider, geoms.collider_name());
  if (number == geom_class()) require_body(geoms.collider, geoms.collider_name());
}

Proximity find_proximity_of(const TwoGeoms& geoms, QueryKind kind) {
  require_supported(geoms);
  const Proximity result = find_query(dGeomGetClass(geoms.collider))(geoms.ours, geoms.collider, kind).deepest;
  if (result.status == Status::InvalidInput || !std::isfinite(result.gap)) geoms.refuse();
  return result;
}

}  // namespace supernormal::ode

using namespace supernormal::ode;

extern "C" int snGeomProximity(dGeomID g1, dGeomID g2, snProximity* out) {
  return answer_query("snGeomProximity", g1, g2, QueryKind::Distance, out);
}

extern "C" int snGeomProximityCertified(dGeomID g1, dGeomID g2, snProximity* out) {
  return answer_query("snGeomProximityCertified", g1, g2, QueryKind::CertifiedDistance, out);
}

extern "C" int snGeomTimeOfImpact(dGeomID g1, dGeomID g2, dReal horizon, snImpact* out) {
  return answer_impact(g1, g2, horizon, out);
}
