// Our bodies and dCylinder.
#include "ode/convert.hpp"
#include "ode/partner.hpp"
#include "ode/solve_pair.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/shapes/cylinder.hpp"

namespace supernormal::ode {

ContactManifold query_cylinder(dGeomID ours, dGeomID partner, Goal goal) {
  dReal radius = 0;
  dReal length = 0;
  dGeomCylinderGetParams(partner, &radius, &length);
  const Cylinder cylinder(radius, 0.5 * double{length});
  const PartnerShape shape{cylinder, pose_of(partner), partner_kind(dCylinderClass, {radius, length})};
  return solve_pair(ours, shape, goal);
}

}  // namespace supernormal::ode
