#include "output/frame.hpp"

#include <algorithm>
#include <limits>

#include "simulation/stepper.hpp"
#include "simulation/world.hpp"

namespace falling_particles {
namespace {

Point to_point(const dReal* v) { return {v[0], v[1], v[2]}; }

int index_of(dGeomID geom, const World& world) {
  const Body* body = body_of(geom);
  return body == nullptr ? kWall : static_cast<int>(body - world.bodies().data());
}

}  // namespace

Extent extent_of(const Frame& frame, double radius) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Extent extent{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  for (const BodyState& body : frame.bodies) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.least[axis] = std::min(extent.least[axis], body.position[axis] - radius);
      extent.most[axis] = std::max(extent.most[axis], body.position[axis] + radius);
    }
  }
  return extent;
}

BodyKinds kinds_of(const World& world, const Scene& scene) {
  BodyKinds kinds{&scene, {}};
  kinds.of_body.reserve(world.bodies().size());
  for (const Body& body : world.bodies()) {
    const auto is_kind = [&](const GrainCount& kind) { return &kind.grain == body.grain; };
    const auto kind = std::ranges::find_if(scene.grains, is_kind);
    kinds.of_body.push_back(static_cast<std::size_t>(kind - scene.grains.begin()));
  }
  return kinds;
}

Frame frame_of(double time, const World& world, const Stepper* stepper) {
  Frame frame;
  frame.time = time;
  frame.bodies.reserve(world.bodies().size());
  for (const Body& body : world.bodies()) {
    frame.bodies.push_back(
        {body.position(), body.quaternion(), to_point(dBodyGetLinearVel(body.body)), to_point(dBodyGetAngularVel(body.body))});
  }
  if (stepper == nullptr) return frame;
  frame.contacts.reserve(stepper->contact_geoms().size());
  for (const dContactGeom& contact : stepper->contact_geoms()) {
    frame.contacts.push_back(
        {to_point(contact.pos), to_point(contact.normal), contact.depth, index_of(contact.g1, world), index_of(contact.g2, world)});
  }
  return frame;
}

}  // namespace falling_particles
