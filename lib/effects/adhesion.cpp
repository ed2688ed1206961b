#include <algorithm>

#include "effects/elastic_geom.hpp"
#include "effects/motion.hpp"
#include "effects/pair_material.hpp"

namespace supernormal::effects {
namespace {

constexpr double kLayer = 1e-4;  // the depth at which rigid contacts stick, relative to the mean half-extent

// ODE pushes rigid contacts apart to depth 0, where rounding would separate the bodies. So each rigid contact that sticks is only
// pushed to a layer of this depth. It may sink deeper into the layer.
void keep_in_touch(Patch& patch) {
  const double layer = kLayer * std::min(mean_half_extent(patch.geom1()), mean_half_extent(patch.geom2()));
  const dBodyID body = patch.body1 != nullptr ? patch.body1 : patch.body2;
  const double erp_of_world = dWorldGetERP(dBodyGetWorld(body));
  for (dContact& contact : patch.contacts) {
    const double erp = (contact.surface.mode & dContactSoftERP) != 0 ? double{contact.surface.soft_erp} : erp_of_world;
    contact.surface.motionN = ode::to_real(-erp / patch.step * layer);
  }
}

}  // namespace

// A contact joint cannot pull. So the attraction is an external force, and the joint carries the reaction.
void add_adhesion(const PairMaterial& pair, Patch& patch) {
  const dBodyID body1 = patch.body1;
  const dBodyID body2 = patch.body2;
  const auto is_awake = [](dBodyID body) { return body != nullptr && dBodyIsEnabled(body) != 0; };
  // ODE would keep the forces on a sleeping body until it wakes.
  if (!is_awake(body1) && !is_awake(body2)) return;
  if ((pair.surface.mode & dContactSoftCFM) == 0) keep_in_touch(patch);
  const Vector3 pull = -pair.pull_off * patch.normal();
  const Vector3 point = patch.middle();
  add_force(body1, pull, point);
  add_force(body2, -pull, point);
}

}  // namespace supernormal::effects
