#include "grain.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace falling_particles {

std::vector<dGeomID> Grain::geoms() const {
  std::vector<dGeomID> all;
  all.reserve(kind->components.size() + 1);
  // ODE lists the last geom first.
  for (dGeomID each = dBodyGetFirstGeom(body); each != nullptr; each = dBodyGetNextGeom(each)) all.push_back(each);
  std::ranges::reverse(all);
  return all;
}

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

Aabb Grain::aabb() const {
  Aabb box = aabb_of(geom);
  if (kind->components.empty()) return box;
  for (const dGeomID each : geoms()) {
    const Aabb other = aabb_of(each);
    for (std::size_t i = 0; i < 6; i += 2) {
      box[i] = std::min(box[i], other[i]);
      box[i + 1] = std::max(box[i + 1], other[i + 1]);
    }
  }
  return box;
}

dGeomID create_geom(dSpaceID space, const ConvexBody& body, double scale) {
  const std::array<double, 3> half_axes = body.core_half_axes();
  const auto [a, b, c] = std::array{scale * half_axes[0], scale * half_axes[1], scale * half_axes[2]};
  dGeomID geom = nullptr;
  switch (body.shape) {
    case ConvexBody::Shape::Superellipsoid:
      geom = body.delta == 2 && body.epsilon == 2 ? snCreateEllipsoid(space, a, b, c)
                                                  : snCreateSuperellipsoid(space, a, b, c, body.delta, body.epsilon);
      break;
    case ConvexBody::Shape::Superovoid:
      geom = snCreateSuperovoid(space, a, b, c, body.delta, body.epsilon, body.taper[0], body.taper[1]);
      break;
    case ConvexBody::Shape::Capsule:
      geom = snCreateCapsule(space, a, 2 * (c - a));
      break;
  }
  if (geom == nullptr || (body.rounding > 0 && snGeomSetRounding(geom, scale * body.rounding) == 0)) {
    throw std::runtime_error(std::string("a grain was refused: ") + snLastError());
  }
  return geom;
}

dGeomID attach_geoms(dSpaceID space, const GrainKind& kind, double scale, dBodyID body, void* data) {
  const auto create = [&](const ConvexBody& shape) {
    dGeomID geom = create_geom(space, shape, scale);
    dGeomSetBody(geom, body);
    dGeomSetData(geom, data);
    dGeomSetCategoryBits(geom, kGrainBit);
    dGeomSetCollideBits(geom, kGrainBit | kWallBit);
    return geom;
  };
  dGeomID first = nullptr;
  for (const Component& component : kind.all_components()) {
    dGeomID geom = create(component.body);
    if (first == nullptr) first = geom;
    if (kind.components.empty()) break;  // without an offset, which costs time in every step
    const auto [x, y, z] = component.position;
    const auto [qw, qx, qy, qz] = component.quaternion;
    const dQuaternion q = {qw, qx, qy, qz};
    dGeomSetOffsetPosition(geom, scale * x, scale * y, scale * z);
    dGeomSetOffsetQuaternion(geom, q);
  }
  return first;
}

void put(dBodyID body, const Placement& place) {
  const auto [x, y, z] = place.position;
  const auto [qw, qx, qy, qz] = place.quaternion;
  const dQuaternion q = {qw, qx, qy, qz};
  dBodySetPosition(body, x, y, z);
  dBodySetQuaternion(body, q);
  dBodySetLinearVel(body, place.velocity[0], place.velocity[1], place.velocity[2]);
  dBodySetAngularVel(body, place.angular_velocity[0], place.angular_velocity[1], place.angular_velocity[2]);
}

dMass mass_of(const Grain& grain) {
  dMass mass;
  if (const auto& compound = grain.kind->compound_mass) {
    const double volume = std::pow(grain.scale, 3);
    const double second_moment = std::pow(grain.scale, 5);
    const auto& I = compound->inertia;
    dMassSetParameters(&mass, volume * compound->mass, 0, 0, 0, second_moment * I[0][0], second_moment * I[1][1],
                       second_moment * I[2][2], second_moment * I[0][1], second_moment * I[0][2], second_moment * I[1][2]);
  } else if (snMassSet(&mass, grain.kind->density, grain.geom) == 0) {
    throw std::runtime_error("mass of grain \"" + grain.kind->name + "\" was refused: " + snLastError());
  }
  return mass;
}

double kinetic_energy(const Grain& grain) {
  const dReal* v = dBodyGetLinearVel(grain.body);
  const dReal* w = dBodyGetAngularVel(grain.body);
  dVector3 spin;  // in the grain's frame, where the inertia is constant
  dBodyVectorFromWorld(grain.body, w[0], w[1], w[2], spin);
  double twice_rotation = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) twice_rotation += spin[i] * grain.mass.I[4 * i + j] * spin[j];
  }
  return 0.5 * (grain.mass.mass * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + twice_rotation);
}

double energy_of(const Grain& grain, const Scene& scene) {
  double energy = kinetic_energy(grain);
  const auto* const gravity = scene.gravity();
  if (gravity == nullptr) return energy;
  const Point position = grain.position();
  for (std::size_t i = 0; i < 3; ++i) {
    energy -= grain.mass.mass * gravity->acceleration[static_cast<Eigen::Index>(i)] * position[i];
  }
  return energy;
}

}  // namespace falling_particles
