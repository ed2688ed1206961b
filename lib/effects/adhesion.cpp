#include <algorithm>

#include "effects/elastic_geom.hpp"
#include "effects/motion.hpp"
#include "effects/pair_material.hpp"

namespace supernormal::effects {
namespace {

constexpr double kLayer = 1e-4;  // depth at which rigid contacts stick, relative to the mean half-extent

// ODE pushes overlaps out to nothing, and rounding would then part the bodies. So each rigid contact that sticks is pushed only to
// a layer of this depth, and may sink into it.
void keep_in_touch(Patch& patch) {
  const double layer = kLayer * std::min(mean_half_extent(patch.geom1()), mean_half_extent(patch.geom2()));
  const dBodyID body = patch.body1 != nullptr ? patch.body1 : patch.body2;
  const double rate = dWorldGetERP(dBodyGetWorld(body)) / patch.step;
  for (dContact& contact : patch.contacts) contact.surface.motionN = ode::to_real(-rate * layer);
}

}  // namespace

// A contact joint cannot pull, so the attraction is an external force that the joint has to hold.
void add_adhesion(const PairMaterial& pair, Patch& patch) {
  const dBodyID body1 = patch.body1;
  const dBodyID body2 = patch.body2;
  const auto is_awake = [](dBodyID body) { return body != nullptr && dBodyIsEnabled(body) != 0; };
  // ODE keeps the forces on a sleeping body until it wakes.
  if (!is_awake(body1) && !is_awake(body2)) return;
  if ((pair.surface.mode & dContactSoftCFM) == 0) keep_in_touch(patch);
  const Vector3 pull = -pair.pull_off * patch.normal();
  const Vector3 point = patch.middle();
  add_force(body1, pull, point);
  add_force(body2, -pull, point);
}

}  // namespace supernormal::effects
