// Our bodies and dBox.
#include "ode/convert.hpp"
#include "ode/partner.hpp"
#include "ode/solve_pair.hpp"
#include "ode/warm_start.hpp"
#include "supernormal/shapes/box.hpp"

namespace supernormal::ode {

ContactPatch query_box(dGeomID ours, dGeomID partner, Goal goal) {
  dVector3 lengths;
  dGeomBoxGetLengths(partner, lengths);
  const Box box(0.5 * to_vector(lengths));
  const PartnerShape shape{box, pose_of(partner), partner_kind(dBoxClass, {lengths[0], lengths[1], lengths[2]})};
  Proximity result = solve_pair(ours, shape, goal);
  result.contact += 0.5 * result.gap * result.normal;  // onto the box, where ODE's own contacts of dSphere and dBox are
  return patch_of_pair(ours, shape, result, goal);
}

}  // namespace supernormal::ode
