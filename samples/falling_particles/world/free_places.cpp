#include "free_places.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace falling_particles {
namespace {

using Aabb = std::array<dReal, 6>;  // x, x, y, y, z, z

Aabb aabb_of(dGeomID geom) {
  Aabb aabb;
  dGeomGetAABB(geom, aabb.data());
  return aabb;
}

bool meet(const Aabb& a, const Aabb& b) {
  for (std::size_t i = 0; i < 6; i += 2) {
    if (a[i] > b[i + 1] || b[i] > a[i + 1]) return false;
  }
  return true;
}

}  // namespace

Candidate::Candidate(const GrainKind& kind, double scale)
    : world_(dWorldCreate()), grain_{dBodyCreate(world_), nullptr, &kind, {}, scale} {
  grain_.geom = attach_geoms(nullptr, kind, scale, grain_.body, nullptr);
  grain_.mass = mass_of(grain_);
  geoms_ = grain_.geoms();
}

Candidate::~Candidate() {
  std::ranges::for_each(geoms_, dGeomDestroy);
  dWorldDestroy(world_);
}

Neighbourhood::Neighbourhood(const World& world, const Region& region) {
  Aabb box;
  for (std::size_t i = 0; i < 3; ++i) {
    box[2 * i] = region.corner[i];
    box[2 * i + 1] = region.corner[i] + region.size[i];
  }
  const auto add_if_near = [&](dGeomID geom) {
    if (dGeomIsEnabled(geom) != 0 && meet(aabb_of(geom), box)) geoms_.push_back(geom);
  };
  world.sweep().for_each_geom(add_if_near);
  std::ranges::for_each(world.walls().geoms(), add_if_near);
}

bool Neighbourhood::is_free(dGeomID geom) const {
  const Aabb own = aabb_of(geom);
  return std::ranges::none_of(geoms_, [&](dGeomID other) {
    if (!meet(own, aabb_of(other))) return false;
    snProximity proximity;
    if (snGeomProximity(geom, other, &proximity) == 0) throw std::runtime_error(std::string("snGeomProximity: ") + snLastError());
    return !(proximity.gap > 0);
  });
}

Placement random_place(const Region& region, std::size_t kind, double scale, double radius, Random& random) {
  Placement place{kind, {}, {}, scale};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double room = std::max(0.0, region.size[axis] - 2 * radius);
    place.position[axis] = region.corner[axis] + radius + room * random.uniform();
  }
  place.quaternion = random.rotation();
  return place;
}

}  // namespace falling_particles
