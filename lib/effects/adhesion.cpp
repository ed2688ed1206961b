#include <algorithm>

#include "effects/elastic_geom.hpp"
#include "effects/motion.hpp"
#include "effects/pair_material.hpp"

namespace supernormal::effects {
namespace {

constexpr double kLayer = 1e-4;  // depth at which rigid contacts stick, relative to the mean half-extent

// ODE pushes overlaps out to nothing, and rounding would then part the bodies. So a rigid contact that sticks is pushed only to a
// layer of this depth, and may sink into it; corners, whose depth is 0, sink with the deepest.
void keep_in_touch(Patch& patch) {
  const dContactGeom& geom = patch.deepest().geom;
  const double layer = kLayer * std::min(mean_half_extent(geom.g1), mean_half_extent(geom.g2));
  const dBodyID body = patch.body1 != nullptr ? patch.body1 : patch.body2;
  const double rate = dWorldGetERP(dBodyGetWorld(body)) / patch.step;
  const double missing = std::max(0.0, layer - geom.depth);
  for (dContact& contact : patch.contacts) {
    contact.surface.motionN = ode::to_real(-rate * (contact.geom.depth > 0 ? layer : missing));
  }
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
  const double share = pair.pull_off / patch.bearers();
  for (const dContact& contact : patch.contacts) {
    if (!patch.bears(contact)) continue;
    const Vector3 pull = -share * ode::to_vector(contact.geom.normal);
    const Vector3 point = ode::to_vector(contact.geom.pos);
    add_force(body1, pull, point);
    add_force(body2, -pull, point);
  }
}

}  // namespace supernormal::effects
