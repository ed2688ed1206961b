#include "world.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

namespace falling_particles {
namespace {

/// The data that World::name_pairs passes through ODE.
struct PairCallback {
  const SweepSpace& sweep;
  void* data;
  dNearCallback* callback;
};

/// The capacity for all grains of a run: grains must not move in memory.
std::size_t capacity(const Scene& scene, std::size_t at_start) {
  return static_cast<std::size_t>(static_cast<double>(at_start) + most_fed(scene));
}

bool set_defaults(const Query& query) {
  if (snSetDefaultSolver(query.solver, query.tolerance, query.max_evaluations) == 0) return false;
  snSetWarmStart(query.warm_start ? 1 : 0);
  return true;
}

void call_for_pair(void* to, dGeomID g1, dGeomID g2) {
  const auto& [sweep, data, callback] = *static_cast<const PairCallback*>(to);
  if (!sweep.is_end_marker(g1)) callback(data, g1, g2);
}

}  // namespace

QueryDefaults::QueryDefaults(const std::optional<Query>& query) : are_changed_(query.has_value()) {
  if (are_changed_ && !set_defaults(*query)) throw std::runtime_error(snLastError());
}

QueryDefaults::~QueryDefaults() {
  if (are_changed_) set_defaults({});  // the defaults are never refused
}

World::World(const Scene& scene) : scene_(scene), query_defaults_(scene.query) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateFlagBasicData | dAllocateFlagCollisionData);
  world_ = dWorldCreate();
  sweep_ = std::make_unique<SweepSpace>();
  if (const auto& accuracy = scene.solver.stepper) {
    stepper_ = std::make_unique<supernormal::ode::Stepper>(world_);
    stepper_->set_accuracy(accuracy->sag, accuracy->least, accuracy->most);
  }
  // Quickstep shuffles its constraints with ODE's global random generator.
  dRandSetSeed(static_cast<unsigned long>(scene.seed & 0xffffffffU));
  set_parameters(scene);
  // The walls are in no space, since ODE pairs geoms of infinite height with all others. Each wall is tested against the bounding
  // boxes of the grains.
  walls_ = std::make_unique<WallBodies>(world_, scene.walls, scene.time.step, kWallBit, kGrainBit, stepper_.get());
}

World::World(const Scene& scene, const std::vector<Placement>& placements) : World(scene) {
  grains_.reserve(capacity(scene, placements.size()));
  for (const Placement& placement : placements) add_grain(placement);
  add_cell();
  if (!scene.bonds.empty()) bonds_ = std::make_unique<Bonds>(*this);
}

World::World(const Scene& scene, GoOn /*how*/, const WorldState& state) : World(scene) {
  grains_.reserve(capacity(scene, static_cast<std::size_t>(scene.grains_at_start())));
  for (const SavedGrain& saved : state.grains) restore(saved);
  add_cell();
  if (cell_ != nullptr) cell_->set_lengths(state.periods);
  walls_->restore(state.walls);
  if (!state.has_lid) walls_->remove_lid();
  if (!scene.bonds.empty()) bonds_ = std::make_unique<Bonds>(*this, state.bonds);
  const bool was_moved_by_stepper = !state.stepper.empty();  // a program may change the solver
  if (stepper_ != nullptr && was_moved_by_stepper) stepper_->load(all_geoms(), state.stepper);
  dRandSetSeed(static_cast<unsigned long>(state.seed));
}

void World::add_cell() {
  PeriodicAxes axes = scene_.periodic;
  if (const Periodic* cube = std::get_if<Periodic>(&scene_.container)) axes.fill(Period{0, cube->side});
  if (is_any(axes)) cell_ = std::make_unique<PeriodicCell>(*this, axes);
}

World::~World() {
  stepper_.reset();
  bonds_.reset();
  cell_.reset();
  walls_.reset();
  sweep_.reset();
  effects_.reset();  // it has joints
  dWorldDestroy(world_);
  snClose();
  dCloseODE();
}

void World::name_wall_pairs(void* data, dNearCallback* callback) const {
  const auto grains = reinterpret_cast<dGeomID>(sweep_->id());  // a space is a geom to ODE
  for (dGeomID wall : walls_->geoms()) dSpaceCollide2(grains, wall, data, callback);
}

void World::name_pairs(void* data, dNearCallback* callback) const {
  PairCallback to{*sweep_, data, callback};
  dSpaceCollide(sweep_->id(), &to, call_for_pair);
  name_wall_pairs(data, callback);
}

void World::set_parameters(const Scene& scene) {
  if (!scene.solver.stepper) {
    dWorldSetQuickStepNumIterations(world_, scene.solver.iterations);
    dWorldSetERP(world_, scene.solver.erp);
    dWorldSetCFM(world_, scene.solver.cfm);
  }
  // The effects must precede the bodies, which inherit some settings from the world.
  effects_ = std::make_unique<supernormal::effects::Effects>(scene.effects, scene.time.step, scene.solver.solves_contacts());
  effects_->set_up(world_);
}

std::size_t World::insert(const Placement& placement) {
  if (grains_.size() == grains_.capacity()) throw std::logic_error("feeders bring more grains than they may");
  add_grain(placement);
  if (cell_ != nullptr) cell_->add_last();
  return grains_.size() - 1;
}

void World::remove(std::size_t index) {
  Grain& entry = grains_[index];
  if (cell_ != nullptr) cell_->remove(index);
  if (bonds_ != nullptr) bonds_->release(index);
  effects_->remove_body(entry.body);
  if (stepper_ != nullptr) stepper_->remove_body(entry.body);
  std::ranges::for_each(entry.geoms(), dGeomDestroy);
  dBodyDestroy(entry.body);
  entry.geom = nullptr;
  entry.body = nullptr;
  present_.erase(std::ranges::lower_bound(present_, index));
}

void World::add_grain(const Placement& placement) {
  const GrainKind& kind = scene_.kinds[placement.kind].kind;
  present_.push_back(grains_.size());
  // The capacity is reserved: grains do not move, and geoms point to them.
  Grain& entry = grains_.emplace_back(Grain{dBodyCreate(world_), nullptr, &kind, {}, placement.scale});
  entry.geom = attach_geoms(sweep_->id(), kind, entry.scale, entry.body, &entry);
  entry.mass = mass_of(entry);
  dBodySetMass(entry.body, &entry.mass);
  put(entry.body, placement);
  effects_->add_body(entry.body);
  if (stepper_ == nullptr) return;
  stepper_->add_body(entry.body);
  dBodySetData(entry.body, &entry.move);
}

std::vector<dGeomID> World::all_geoms() const {
  std::vector<dGeomID> geoms = walls_->geoms();
  for (const Grain& grain : present()) std::ranges::copy(grain.geoms(), std::back_inserter(geoms));
  return geoms;
}

WorldState World::save() const {
  WorldState state;
  state.seed = dRandGetSeed();
  state.has_lid = walls_->has_lid();
  if (cell_ != nullptr) state.periods = cell_->lengths();
  state.walls = walls_->save();
  if (bonds_ != nullptr) state.bonds = bonds_->save();
  if (stepper_ != nullptr) state.stepper = stepper_->save(all_geoms());
  state.grains.reserve(grains_.size());
  for (const Grain& grain : grains_) {
    SavedGrain& saved = state.grains.emplace_back();
    saved.kind = scene_.kind_of(*grain.kind);
    saved.scale = grain.scale;
    saved.mass = grain.mass.mass;
    saved.is_present = grain.is_present();
    if (!grain.is_present()) continue;
    saved.is_awake = dBodyIsEnabled(grain.body) != 0;
    saved.position = grain.position();
    saved.quaternion = grain.quaternion();
    saved.velocity = grain.velocity();
    saved.angular_velocity = grain.angular_velocity();
  }
  return state;
}

void World::restore(const SavedGrain& saved) {
  const auto kind = static_cast<std::size_t>(saved.kind);
  if (!saved.is_present) {
    Grain& gone = grains_.emplace_back(Grain{nullptr, nullptr, &scene_.kinds[kind].kind, {}, saved.scale});
    gone.mass.mass = saved.mass;
    return;
  }
  add_grain({kind, saved.position, saved.quaternion, saved.scale, saved.velocity, saved.angular_velocity});
  if (!saved.is_awake) dBodyDisable(grains_.back().body);
}

}  // namespace falling_particles
