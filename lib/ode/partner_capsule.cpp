// Our bodies and dCapsule.
#include "ode/convert.hpp"
#include "ode/partner.hpp"
#include "ode/solve_pair.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/shapes/capsule.hpp"

namespace supernormal::ode {

ContactManifold query_capsule(dGeomID ours, dGeomID partner, Goal goal) {
  dReal radius = 0;
  dReal length = 0;
  dGeomCapsuleGetParams(partner, &radius, &length);
  const Capsule capsule(radius, 0.5 * double{length});
  const PartnerShape shape{capsule, pose_of(partner), partner_kind(dCapsuleClass, {radius, length})};
  return solve_pair(ours, shape, goal);
}

}  // namespace supernormal::ode
