#include "world.hpp"

#include <supernormal/supernormal.h>

#include <algorithm>
#include <cmath>
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

Point to_point(const dReal* v) { return {v[0], v[1], v[2]}; }

/// The capacity for all grains of a run: grains must not move in memory.
std::size_t capacity(const Scene& scene, std::size_t at_start) {
  return static_cast<std::size_t>(static_cast<double>(at_start) + most_fed(scene));
}

void call_for_pair(void* to, dGeomID g1, dGeomID g2) {
  const auto& [sweep, data, callback] = *static_cast<const PairCallback*>(to);
  if (!sweep.is_end_marker(g1)) callback(data, g1, g2);
}

}  // namespace

std::vector<dGeomID> Grain::geoms() const {
  std::vector<dGeomID> all;
  all.reserve(kind->components.size() + 1);
  // ODE lists the last geom first.
  for (dGeomID each = dBodyGetFirstGeom(body); each != nullptr; each = dBodyGetNextGeom(each)) all.push_back(each);
  std::ranges::reverse(all);
  return all;
}

std::array<dReal, 6> Grain::aabb() const {
  std::array<dReal, 6> box{};
  dGeomGetAABB(geom, box.data());
  if (kind->components.empty()) return box;
  for (const dGeomID each : geoms()) {
    std::array<dReal, 6> other{};
    dGeomGetAABB(each, other.data());
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

World::World(const Scene& scene) : scene_(scene), query_defaults_(scene.query) {
  dInitODE2(0);
  dAllocateODEDataForThread(dAllocateFlagBasicData | dAllocateFlagCollisionData);
  world_ = dWorldCreate();
  sweep_ = std::make_unique<SweepSpace>(scene.sweep_axis);
  // Quickstep shuffles its constraints with ODE's global random generator.
  dRandSetSeed(static_cast<unsigned long>(scene.seed & 0xffffffffU));
  set_parameters(scene);
  // The walls are in no space. ODE pairs geoms of infinite height with all others, whatever their bounding boxes. Instead each wall
  // is tested against the grains, at the cost of comparing bounding boxes.
  walls_ = std::make_unique<WallBodies>(world_, scene.walls, scene.time.step, kWallBit, kGrainBit);
}

World::World(const Scene& scene, const std::vector<Placement>& placements) : World(scene) {
  grains_.reserve(capacity(scene, placements.size()));
  for (const Placement& placement : placements) add_grain(placement);
  add_cell();
}

World::World(const Scene& scene, GoOn /*how*/, const WorldState& state) : World(scene) {
  grains_.reserve(capacity(scene, static_cast<std::size_t>(scene.grains_at_start())));
  for (const SavedGrain& saved : state.grains) restore(saved);
  add_cell();
  if (cell_ != nullptr) cell_->set_lengths(state.periods);
  walls_->restore(state.walls);
  if (!state.has_lid) walls_->remove_lid();
  dRandSetSeed(static_cast<unsigned long>(state.seed));
}

void World::add_cell() {
  PeriodicAxes axes = scene_.periodic;
  if (const Periodic* cube = std::get_if<Periodic>(&scene_.container)) axes.fill(Period{0, cube->side});
  if (is_any(axes)) cell_ = std::make_unique<PeriodicCell>(*this, axes);
}

World::~World() {
  cell_.reset();
  walls_.reset();
  sweep_.reset();
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
  dWorldSetQuickStepNumIterations(world_, scene.solver.iterations);
  dWorldSetERP(world_, scene.solver.erp);
  dWorldSetCFM(world_, scene.solver.cfm);
  // The effects must precede the bodies, which inherit some settings from the world.
  effects_ = std::make_unique<supernormal::effects::Effects>(scene.effects, scene.time.step);
  effects_->set_up(world_);
}

std::size_t World::insert(const Placement& placement, const Point& velocity) {
  if (grains_.size() == grains_.capacity()) throw std::logic_error("feeders bring more grains than they may");
  add_grain(placement);
  dBodySetLinearVel(grains_.back().body, velocity[0], velocity[1], velocity[2]);
  if (cell_ != nullptr) cell_->add_last();
  return grains_.size() - 1;
}

void World::remove(std::size_t index) {
  Grain& entry = grains_[index];
  if (cell_ != nullptr) cell_->remove(index);
  effects_->remove_body(entry.body);
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
}

WorldState World::save() const {
  WorldState state;
  state.seed = dRandGetSeed();
  state.has_lid = walls_->has_lid();
  if (cell_ != nullptr) state.periods = cell_->lengths();
  state.walls = walls_->save();
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
    saved.velocity = to_point(dBodyGetLinearVel(grain.body));
    saved.angular_velocity = to_point(dBodyGetAngularVel(grain.body));
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
  add_grain({kind, saved.position, saved.quaternion, saved.scale});
  dBodyID body = grains_.back().body;
  dBodySetLinearVel(body, saved.velocity[0], saved.velocity[1], saved.velocity[2]);
  dBodySetAngularVel(body, saved.angular_velocity[0], saved.angular_velocity[1], saved.angular_velocity[2]);
  if (!saved.is_awake) dBodyDisable(body);
}

}  // namespace falling_particles
