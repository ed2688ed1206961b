#include "world.hpp"

#include <supernormal/supernormal.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace falling_particles {
namespace {

constexpr unsigned long kWallBit = 1;
constexpr unsigned long kGrainBit = 2;

/// Hash space: its cost grows as the number of grains, where sweep and prune sorts along one axis on which a settled bed overlaps
/// throughout. One level per power of two from the smallest to the largest bounding box, so that every grain sits in a cell of its
/// own size; ODE's default range is for metres. The walls, larger, are tested against everybody.
dSpaceID create_space(const Scene& scene) {
  dSpaceID space = dHashSpaceCreate(nullptr);
  const int finest = static_cast<int>(std::ceil(std::log2(2 * scene.smallest_half_axis())));
  const int coarsest = static_cast<int>(std::ceil(std::log2(2 * scene.largest_bounding_radius())));
  dHashSpaceSetLevels(space, finest, coarsest);
  return space;
}

}  // namespace

dGeomID create_geom(dSpaceID space, const Grain& grain) {
  const double r = grain.rounding;
  const auto [a, b, c] = grain.half_axes;
  dGeomID geom = grain.delta == 2 && grain.epsilon == 2
                     ? snCreateEllipsoid(space, a - r, b - r, c - r)
                     : snCreateSuperellipsoid(space, a - r, b - r, c - r, grain.delta, grain.epsilon);
  if (geom == nullptr || (r > 0 && snGeomSetRounding(geom, r) == 0)) {
    throw std::runtime_error("grain \"" + grain.name + "\" was refused: " + snLastError());
  }
  return geom;
}

World::World(const Scene& scene, const std::vector<Placement>& placements) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateFlagBasicData | dAllocateFlagCollisionData);
  world_ = dWorldCreate();
  space_ = create_space(scene);
  // Quickstep shuffles its constraints with ODE's global generator.
  dRandSetSeed(static_cast<unsigned long>(scene.seed & 0xffffffffU));
  set_parameters(scene);
  walls_.emplace(space_, scene.container, kWallBit, kGrainBit);  // walls overlap one another, which is nobody's business
  bodies_.reserve(placements.size());
  for (const Placement& placement : placements) add_body(scene.grains[placement.kind].grain, placement);
  if (const Periodic* periodic = std::get_if<Periodic>(&scene.container))
    cell_ = std::make_unique<PeriodicCell>(*this, periodic->side);
}

World::~World() {
  cell_.reset();
  walls_.reset();
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
  snClose();
  dCloseODE();
}

void World::set_parameters(const Scene& scene) {
  dWorldSetQuickStepNumIterations(world_, scene.solver.iterations);
  dWorldSetERP(world_, scene.solver.erp);
  dWorldSetCFM(world_, scene.solver.cfm);
  // Before the bodies are made, which take some settings from the world.
  effects_ = std::make_unique<supernormal::effects::Effects>(scene.effects, scene.time.step);
  effects_->set_up(world_);
}

void World::add_body(const Grain& grain, const Placement& placement) {
  Body& entry = bodies_.emplace_back(Body{dBodyCreate(world_), create_geom(space_, grain), &grain, {}});
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
