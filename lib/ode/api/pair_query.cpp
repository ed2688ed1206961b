// Queries of two geoms: snGeomProximity, snGeomProximityCertified, snGeomTimeOfImpact, snGeomGapGradient, snGeomDerivatives,
// snGeomClearance and snGeomIsFartherThan.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "ode/colliders/collider.hpp"
#include "ode/colliders/convex/posed_shape.hpp"
#include "ode/colliders/impact.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/geom_class.hpp"
#include "ode/support/last_error.hpp"
#include "ode/support/require.hpp"
#include "proximity/derivatives/gradient_of_answer.hpp"
#include "supernormal/proximity/clearance.hpp"
#include "supernormal/proximity/derivatives.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::ode {
namespace {

/// Two geoms in the order in which the core asks about them: body 1 is ours.
struct TwoGeoms {
  dGeomID ours, collider;
  bool is_swapped = false;  ///< whether `ours` is the second argument

  /// Throws std::invalid_argument if one of the pointers is null, both geoms are the same, or none is ours.
  TwoGeoms(dGeomID g1, dGeomID g2, const void* out) : ours(g1), collider(g2) {
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

  const char* our_name() const { return is_swapped ? "g2" : "g1"; }       ///< the argument in messages
  const char* collider_name() const { return is_swapped ? "g1" : "g2"; }  ///< the argument in messages

  /// Throws std::invalid_argument with the reason why the core has no answer.
  [[noreturn]] void refuse() const { refuse_pair(ours, collider, our_name(), collider_name()); }
};

/// Throws std::invalid_argument if the pair is not supported.
void require_supported(const TwoGeoms& geoms) {
  const int number = dGeomGetClass(geoms.collider);
  if (find_query(number) == nullptr) refuse_class(geoms.collider, geoms.collider_name());
  if (number == geom_class()) require_body(geoms.collider, geoms.collider_name());
}

/// The answer of the core for two geoms. Throws std::invalid_argument if the pair is not supported or there is no answer.
Proximity find_proximity_of(const TwoGeoms& geoms, QueryKind kind) {
  require_supported(geoms);
  const Proximity result = find_query(dGeomGetClass(geoms.collider))(geoms.ours, geoms.collider, kind).deepest;
  if (result.status == Status::InvalidInput || !std::isfinite(result.gap)) geoms.refuse();
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
  return succeeds(function, [&] {
    const TwoGeoms geoms(g1, g2, out);
    write(find_proximity_of(geoms, kind), geoms.is_swapped, *out);
  });
}

constexpr int kTwist = 12;

static_assert(SN_MAX_PARAMETERS == ParameterGradient::kCapacity);
static_assert(SN_DERIVATIVES_SMOOTH == static_cast<int>(DerivativeStatus::Smooth));
static_assert(SN_DERIVATIVES_SEVERAL_MAXIMA == static_cast<int>(DerivativeStatus::SeveralMaxima));
static_assert(SN_DERIVATIVES_NOT_CONVERGED == static_cast<int>(DerivativeStatus::NotConverged));

/// The answer of an earlier query, from g1 to g2.
Proximity answer_of(const snProximity& at) {
  if (!std::isfinite(at.gap)) throw std::invalid_argument("at->gap = " + to_text(at.gap) + " m is not finite");
  Proximity answer;
  answer.gap = at.gap;
  answer.status = at.converged != 0 ? Status::Converged : Status::Stalled;
  answer.normal = require_finite("at->normal", to_vector(at.normal));
  if (!(std::abs(answer.normal.norm() - 1) < 1e-3)) {
    throw std::invalid_argument("at->normal has the length " + to_text(answer.normal.norm()) + ", but must have 1");
  }
  answer.normal.normalize();
  answer.point1 = require_finite("at->point1", to_vector(at.point1));
  answer.point2 = require_finite("at->point2", to_vector(at.point2));
  answer.contact = 0.5 * (answer.point1 + answer.point2);
  return answer;
}

/// The point about which the twists of a geom rotate, a body or a mesh.
Vector3 origin_of(dGeomID geom) {
  if (dGeomGetClass(geom) != dHeightfieldClass) return to_vector(dGeomGetPosition(geom));
  dVector3 origin;
  dGeomGetRelPointPos(geom, 0, 0, 0, origin);  // it may have no position
  return to_vector(origin);
}

void write_rows(const auto& matrix, dReal (*rows)[kTwist]) {
  for (int i = 0; i < matrix.rows(); ++i) {
    for (int j = 0; j < kTwist; ++j) rows[i][j] = to_real(matrix(i, j));
  }
}

int write_parameters(const ParameterGradient& gradient, snParameter* out) {
  for (std::size_t k = 0; k < gradient.size(); ++k) out[k] = {gradient[k].name, to_real(gradient[k].value)};
  return static_cast<int>(gradient.size());
}

void write(const ProximityDerivatives& found, snDerivatives& out) {
  out = {};
  out.status = static_cast<snDerivativeStatus>(found.status);
  out.has_gap = found.has_gap ? 1 : 0;
  out.has_normal = found.has_normal ? 1 : 0;
  out.has_points = found.has_points ? 1 : 0;
  for (int j = 0; j < kTwist; ++j) out.gap[j] = to_real(found.gap_gradient[j]);
  write_rows(found.normal, out.normal);
  write_rows(found.point1, out.point1);
  write_rows(found.point2, out.point2);
  write_rows(found.gap_hessian, out.gap_hessian);
  out.parameters1 = write_parameters(found.parameters1, out.parameter1);
  out.parameters2 = write_parameters(found.parameters2, out.parameter2);
  out.evaluations = found.evaluations;
}

/// The same pair with body 2 as body 1.
ProximityDerivatives swapped(const ProximityDerivatives& found) {
  const auto columns = [](const TwistJacobian& J) {
    TwistJacobian out;
    out << J.rightCols<6>(), J.leftCols<6>();
    return out;
  };
  ProximityDerivatives out = found;
  out.gap_gradient << found.gap_gradient.tail<6>(), found.gap_gradient.head<6>();
  out.normal = -columns(found.normal);
  out.point1 = columns(found.point2);
  out.point2 = columns(found.point1);
  const auto block = [&](int i, int j) { return found.gap_hessian.block<6, 6>(6 * i, 6 * j); };
  out.gap_hessian << block(1, 1), block(1, 0), block(0, 1), block(0, 0);
  std::swap(out.parameters1, out.parameters2);
  out.common_normal = -found.common_normal;
  return out;
}

ProximityDerivatives plane_derivatives(const TwoGeoms& geoms, const DerivativeSettings& settings = {}) {
  dVector4 plane;
  dGeomPlaneGetParams(geoms.collider, plane);
  const Pose pose = pose_of(geoms.ours);
  const ProximityDerivatives found =
      find_plane_derivatives(require_body(geoms.ours).shape(), pose, to_vector(plane), plane[3], settings);
  return geoms.is_swapped ? swapped(found) : found;
}

/// The geoms in the order of the arguments, as shapes of the core.
struct PosedPair {
  PosedShape one, two;

  PosedPair(dGeomID g1, dGeomID g2) : one(g1), two(g2) {}
  ProximityQuery query(const Vector3* first_normal) const {
    return {&one.shape(), &one.pose(), &two.shape(), &two.pose(), first_normal};
  }
};

ProximityDerivatives derivatives_of(const TwoGeoms& geoms, dGeomID g1, dGeomID g2, const snProximity& at) {
  const Proximity answer = answer_of(at);
  if (dGeomGetClass(geoms.collider) == dPlaneClass) return plane_derivatives(geoms);
  if (!has_shape(geoms.collider)) {
    throw std::invalid_argument(std::string(geoms.collider_name()) + " is " + geom_class_name(geoms.collider) +
                                ", but must be a body made by snCreate…, a convex geom of ODE, a dPlane or a dRay");
  }
  const PosedPair pair(g1, g2);
  return find_proximity_derivatives(pair.one.shape(), pair.one.pose(), pair.two.shape(), pair.two.pose(), answer);
}

/// A geom without a shape has the answer of snGeomProximity.
Clearance clearance_by_query(const TwoGeoms& geoms) {
  const Proximity answer = find_proximity_of(geoms, QueryKind::Distance);
  return {answer.gap - answer.error, geoms.is_swapped ? Vector3(-answer.normal) : answer.normal, answer.evaluations};
}

/// The answer of `ask` for the shapes, with the normal in the world frame, or of a query.
Clearance clearance_of(const TwoGeoms& geoms, dGeomID g1, dGeomID g2, auto ask) {
  Clearance found;
  if (has_shape(geoms.collider)) {
    const PosedPair pair(g1, g2);
    found = ask(pair);
    found.normal = pair.one.pose().rotation * found.normal;
  } else {
    found = clearance_by_query(geoms);
  }
  if (!std::isfinite(found.lower_bound)) geoms.refuse();
  return found;
}

/// The gradient of snGeomDerivatives. A mesh has none but that of the answer's points.
GapGradient gap_gradient_of(const TwoGeoms& geoms, dGeomID g1, dGeomID g2, const snProximity& at) {
  require_supported(geoms);  // ODE ends the program at the position of a space
  const Proximity answer = answer_of(at);
  if (dGeomGetClass(geoms.collider) == dPlaneClass) {
    const ProximityDerivatives found = plane_derivatives(geoms, {.hessian = false, .parameters = false});
    return {found.status, found.has_gap, found.gap_gradient, found.evaluations};
  }
  if (has_shape(geoms.collider)) {
    const PosedPair pair(g1, g2);
    return find_gap_gradient(pair.one.shape(), pair.one.pose(), pair.two.shape(), pair.two.pose(), answer);
  }
  Pose pose1, pose2;
  pose1.position = origin_of(g1);
  pose2.position = origin_of(g2);
  if (!is_usable(pose1) || !is_usable(pose2)) return {};
  return {DerivativeStatus::NoHessian, true, gradient_of_answer(pose1, pose2, answer), 0};
}

}  // namespace
}  // namespace supernormal::ode

using namespace supernormal;
using namespace supernormal::ode;

extern "C" int snGeomProximity(dGeomID g1, dGeomID g2, snProximity* out) {
  return answer_query("snGeomProximity", g1, g2, QueryKind::Distance, out);
}

extern "C" int snGeomProximityCertified(dGeomID g1, dGeomID g2, snProximity* out) {
  return answer_query("snGeomProximityCertified", g1, g2, QueryKind::CertifiedDistance, out);
}

extern "C" int snGeomTimeOfImpact(dGeomID g1, dGeomID g2, dReal horizon, snImpact* out) {
  return succeeds("snGeomTimeOfImpact", [&] {
    const TwoGeoms geoms(g1, g2, out);
    require_supported(geoms);
    require_in("horizon", horizon, 0, kMaxHorizon, "s");
    require_velocities_in_range(g1, "linear velocity of g1", "angular velocity of g1", horizon);
    require_velocities_in_range(g2, "linear velocity of g2", "angular velocity of g2", horizon);
    const Impact impact = find_impact(geoms.ours, geoms.collider, horizon);
    if (impact.status == ImpactStatus::InvalidInput) geoms.refuse();
    write(impact, geoms.is_swapped, *out);
  });
}

extern "C" int snGeomGapGradient(dGeomID g1, dGeomID g2, const snProximity* at, dReal gradient[12]) {
  return succeeds("snGeomGapGradient", [&] {
    require_not_null("at", at);
    require_not_null("gradient", gradient);
    const TwoGeoms geoms(g1, g2, gradient);
    const GapGradient found = gap_gradient_of(geoms, g1, g2, *at);
    if (found.status == DerivativeStatus::InvalidInput) geoms.refuse();
    for (int j = 0; j < kTwist; ++j) gradient[j] = to_real(found.gradient[j]);
  });
}

extern "C" int snGeomDerivatives(dGeomID g1, dGeomID g2, const snProximity* at, snDerivatives* out) {
  return succeeds("snGeomDerivatives", [&] {
    require_not_null("at", at);
    const TwoGeoms geoms(g1, g2, out);
    const ProximityDerivatives found = derivatives_of(geoms, g1, g2, *at);
    if (found.status == DerivativeStatus::InvalidInput) geoms.refuse();
    write(found, *out);
  });
}

extern "C" int snGeomClearance(dGeomID g1, dGeomID g2, dReal enough, int max_evaluations, snClearance* out) {
  return succeeds("snGeomClearance", [&] {
    const TwoGeoms geoms(g1, g2, out);
    require_in("max_evaluations", max_evaluations, 1, 3);
    if (std::isnan(enough)) throw std::invalid_argument("enough = nan m, but must be a number");
    const Clearance found = clearance_of(geoms, g1, g2, [&](const PosedPair& pair) {
      return find_clearance(pair.one.shape(), pair.one.pose(), pair.two.shape(), pair.two.pose(), enough, max_evaluations);
    });
    out->lower_bound = to_real(found.lower_bound);
    from_vector(found.normal, out->normal);
    out->normal[3] = 0;
    out->evaluations = found.evaluations;
  });
}

extern "C" int snGeomIsFartherThan(dGeomID g1, dGeomID g2, dReal distance, dVector3 normal) {
  return guarded("snGeomIsFartherThan", 0, [&] {
    const TwoGeoms geoms(g1, g2, &distance);
    if (!std::isfinite(distance)) throw std::invalid_argument("distance = " + to_text(distance) + " m is not finite");
    const Vector3 given = normal == nullptr ? Vector3(Vector3::Zero()) : require_finite("normal", to_vector(normal));
    const Clearance found = clearance_of(geoms, g1, g2, [&](const PosedPair& pair) {
      std::array<Clearance, 1> result;
      std::array<bool, 1> is_farther{};
      const Vector3 first = pair.one.pose().rotation.transpose() * given;
      const std::array<ProximityQuery, 1> queries = {pair.query(given.squaredNorm() > 0 ? &first : nullptr)};
      are_farther_than(queries, distance, result, is_farther);
      return result[0];
    });
    if (normal != nullptr) from_vector(found.normal, normal);
    return found.lower_bound > distance ? 1 : 0;
  });
}
