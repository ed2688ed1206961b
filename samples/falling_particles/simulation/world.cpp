#include "world.hpp"

#include <supernormal/supernormal.h>

#include <stdexcept>
#include <string>

namespace falling_particles {
namespace {

constexpr unsigned long kWallBit = 1;
constexpr unsigned long kGrainBit = 2;

/// The data that World::name_pairs passes through ODE.
struct PairCallback {
  const SweepSpace& sweep;
  void* data;
  dNearCallback* callback;
};

void call_for_pair(void* to, dGeomID g1, dGeomID g2) {
  const auto& [sweep, data, callback] = *static_cast<const PairCallback*>(to);
  if (!sweep.is_end_marker(g1)) callback(data, g1, g2);
}

}  // namespace

dGeomID create_geom(dSpaceID space, const Grain& grain) {
  const auto [a, b, c] = grain.core_half_axes();
  dGeomID geom = grain.delta == 2 && grain.epsilon == 2 ? snCreateEllipsoid(space, a, b, c)
                                                        : snCreateSuperellipsoid(space, a, b, c, grain.delta, grain.epsilon);
  if (geom == nullptr || (grain.rounding > 0 && snGeomSetRounding(geom, grain.rounding) == 0)) {
    throw std::runtime_error("grain \"" + grain.name + "\" was refused: " + snLastError());
  }
  return geom;
}

World::World(const Scene& scene, const std::vector<Placement>& placements) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateFlagBasicData | dAllocateFlagCollisionData);
  world_ = dWorldCreate();
  sweep_ = std::make_unique<SweepSpace>(scene.sweep_axis);
  // Quickstep shuffles its constraints with ODE's global generator.
  dRandSetSeed(static_cast<unsigned long>(scene.seed & 0xffffffffU));
  set_parameters(scene);
  // The walls are in no space: ODE pairs geoms without an upper end with all others, whatever their bounding boxes. Each wall is
  // compared with the grains instead, at the cost of the comparison of their boxes.
  walls_.emplace(nullptr, scene.container, kWallBit, kGrainBit);
  if (!scene.parts.empty()) parts_ = std::make_unique<PartBodies>(world_, scene.parts, scene.time.step, kWallBit, kGrainBit);
  bodies_.reserve(placements.size());
  for (const Placement& placement : placements) add_body(scene.grains[placement.kind].grain, placement);
  if (const Periodic* periodic = std::get_if<Periodic>(&scene.container))
    cell_ = std::make_unique<PeriodicCell>(*this, periodic->side);
}

World::~World() {
  cell_.reset();
  parts_.reset();
  walls_.reset();
  sweep_.reset();
  dWorldDestroy(world_);
  snClose();
  dCloseODE();
}

void World::name_wall_pairs(void* data, dNearCallback* callback) const {
  for (dGeomID wall : walls_->geoms()) {
    // A space is a geom to ODE.
    dSpaceCollide2(reinterpret_cast<dGeomID>(sweep_->id()), wall, data, callback);
  }
  if (parts_ == nullptr) return;
  for (dGeomID part : parts_->geoms()) dSpaceCollide2(reinterpret_cast<dGeomID>(sweep_->id()), part, data, callback);
}

void World::name_pairs(void* data, dNearCallback* callback) const {
  PairCallback to{*sweep_, data, callback};
  dSpaceCollide(sweep_->id(), &to, call_for_pair);
  name_wall_pairs(data, callback);
}

void World::set_parameters(const Scene& scene) {
  dWorldSetQuickStepNumIterations(world_, scene.solver.iterations);
  dWorldSetERP(world_, scene.solver.erp);
  dWorldSetCFM(world_, scene.solver.cfm);
  // The effects come before the bodies, which take some settings from the world.
  effects_ = std::make_unique<supernormal::effects::Effects>(scene.effects, scene.time.step);
  effects_->set_up(world_);
}

void World::add_body(const Grain& grain, const Placement& placement) {
  Body& entry = bodies_.emplace_back(Body{dBodyCreate(world_), create_geom(sweep_->id(), grain), &grain, {}});
  if (snMassSet(&entry.mass, grain.density, entry.geom) == 0) {
    throw std::runtime_error("mass of grain \"" + grain.name + "\" was refused: " + snLastError());
  }
  dBodySetMass(entry.body, &entry.mass);
  dGeomSetBody(entry.geom, entry.body);
  dGeomSetData(entry.geom, &entry);  // bodies_ is reserved: entries stay where they are
  dGeomSetCategoryBits(entry.geom, kGrainBit);
  dGeomSetCollideBits(entry.geom, kGrainBit | kWallBit);
  const auto [x, y, z] = placement.position;
  dBodySetPosition(entry.body, x, y, z);
  const dQuaternion q = {placement.quaternion[0], placement.quaternion[1], placement.quaternion[2], placement.quaternion[3]};
  dBodySetQuaternion(entry.body, q);
  effects_->add_body(entry.body);
}

}  // namespace falling_particles
