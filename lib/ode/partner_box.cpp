// Our bodies and dBox.
#include <span>

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
  ContactPatch patch = solve_pair(ours, shape, goal);
  // Onto the box, where ODE's own contacts of dSphere and dBox are.
  const Vector3 onto_box = 0.5 * patch.deepest.gap * patch.deepest.normal;
  patch.deepest.contact += onto_box;
  for (Vector3& corner : std::span(patch.corners).first(static_cast<std::size_t>(patch.corner_count))) corner += onto_box;
  return patch;
}

}  // namespace supernormal::ode
