#include "grain_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace scene_cost {
namespace {

using common::GeomMaker;
using common::grain_maker;
using common::GrainForm;
using common::OdeGeom;
using common::Stopwatch;
using falling_particles::kContactsPerPair;
using falling_particles::kGrainBit;
using falling_particles::kWallBit;

dSpaceID create_space(SpaceKind kind, const falling_particles::Scene& scene) {
  switch (kind) {
    case SpaceKind::Hash:
      return dHashSpaceCreate(nullptr);
    case SpaceKind::QuadTree: {
      // Blocks are about two of the largest grains wide, over the plan of the container. The quadtree of ODE divides x and y.
      const auto plan = falling_particles::plan_of(scene.container);
      const dVector3 half = {0.5 * plan.width[0], 0.5 * plan.width[1], 1};
      const dVector3 middle = {plan.corner[0] + half[0], plan.corner[1] + half[1], 0};
      const double cells = plan.width[0] / (4 * scene.largest_bounding_radius());
      return dQuadTreeSpaceCreate(nullptr, middle, half, std::clamp(static_cast<int>(std::lround(std::log2(cells))), 1, 8));
    }
    case SpaceKind::SweepAndPrune:
      return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    case SpaceKind::Simple:
      return dSimpleSpaceCreate(nullptr);
  }
  throw std::logic_error("no such space");
}

void collect(void* pairs, dGeomID g1, dGeomID g2) {
  static_cast<std::vector<std::pair<dGeomID, dGeomID>>*>(pairs)->emplace_back(g1, g2);
}

bool is_unit(const dReal* normal) {
  const double square = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  return std::abs(square - 1) < 1e-6;  // false for NaN, too
}

common::GrainBody body_of(const falling_particles::GrainKind& kind) {
  if (kind.is_capsule || !kind.components.empty()) {
    throw std::invalid_argument("\"" + kind.name + "\" is no superellipsoid; other grains have no form in every class");
  }
  return {kind.half_axes, kind.delta, kind.epsilon, kind.rounding};
}

}  // namespace

const char* name_of(SpaceKind kind) {
  constexpr std::array<const char*, 4> kNames = {"hash", "quadtree", "sweep and prune", "simple"};
  return kNames[static_cast<std::size_t>(kind)];
}

GrainWorld::GrainWorld(const falling_particles::Scene& scene, const Snapshot& start, const GrainForm& form, SpaceKind space)
    : scene_(scene),
      world_(scene, start.placements),
      space_(create_space(space, scene)),
      joints_(world_),
      batch_(form.threads == 0 ? nullptr : snBatchCreate(form.threads)) {
  kinds_.reserve(start.placements.size());
  for (const auto& placement : start.placements) kinds_.push_back(placement.kind);
  add_geoms(form);
  set_velocities(start);
  set_space_cells(space);
  for (const dGeomID wall : world_.walls().geoms()) dSpaceAdd(space_, wall);
}

GrainWorld::~GrainWorld() {
  snBatchDestroy(batch_);
  for (const dGeomID wall : world_.walls().geoms()) dSpaceRemove(space_, wall);
  geoms_.clear();
  dSpaceDestroy(space_);
}

void GrainWorld::add_geoms(const GrainForm& form) {
  std::vector<GeomMaker> makers;
  makers.reserve(scene_.kinds.size());
  for (const auto& entry : scene_.kinds) makers.push_back(grain_maker(form, body_of(entry.kind)));
  geoms_.reserve(kinds_.size());
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const falling_particles::Grain& body = world_.grains()[i];
    const dGeomID geom = geoms_.emplace_back(makers[kinds_[i]]()).id();
    dGeomSetBody(geom, body.body);
    dGeomSetData(geom, dGeomGetData(body.geom));  // the effects find the grain through it
    dGeomSetBody(body.geom, nullptr);             // the smooth geom stays behind: moving it would cost time
    dGeomSetCategoryBits(geom, kGrainBit);
    dGeomSetCollideBits(geom, kGrainBit | kWallBit);
    dSpaceAdd(space_, geom);
  }
}

void GrainWorld::set_velocities(const Snapshot& start) {
  for (std::size_t i = 0; i < start.velocities.size(); ++i) {
    const auto& v = start.velocities[i];
    dBodySetLinearVel(world_.grains()[i].body, v[0], v[1], v[2]);
    dBodySetAngularVel(world_.grains()[i].body, v[3], v[4], v[5]);
  }
}

/// Every power of two between the smallest and the largest box of a grain has a level. So each grain is in cells of its own size.
void GrainWorld::set_space_cells(SpaceKind kind) {
  if (kind != SpaceKind::Hash) return;
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0;
  for (const OdeGeom& geom : geoms_) {
    dReal aabb[6];
    dGeomGetAABB(geom.id(), aabb);
    const double side = std::max({aabb[1] - aabb[0], aabb[3] - aabb[2], aabb[5] - aabb[4]});
    smallest = std::min<double>(smallest, side);
    largest = std::max<double>(largest, side);
  }
  dHashSpaceSetLevels(space_, static_cast<int>(std::ceil(std::log2(smallest))), static_cast<int>(std::ceil(std::log2(largest))));
}

void GrainWorld::step() {
  contacts_.clear();
  pairs_.clear();
  if (batch_ != nullptr) {
    collide_batch();
  } else {
    collide_one_by_one();
  }
  {
    const Stopwatch::Lap lap(costs_.joints);
    make_joints();
  }
  {
    const Stopwatch::Lap lap(costs_.solver);
    dWorldQuickStep(world_.id(), scene_.time.step);
  }
  ++costs_.steps;
  costs_.pairs += pairs_.size();
  costs_.contacts += contacts_.size();
}

void GrainWorld::collide_one_by_one() {
  {
    const Stopwatch::Lap lap(costs_.broad);
    dSpaceCollide(space_, &pairs_, collect);
  }
  const Stopwatch::Lap lap(costs_.narrow);
  std::array<dContactGeom, kContactsPerPair> found;
  for (const auto& [g1, g2] : pairs_) {
    const int count = dCollide(g1, g2, kContactsPerPair, found.data(), sizeof(dContactGeom));
    contacts_.insert(contacts_.end(), found.begin(), found.begin() + count);
  }
}

void GrainWorld::collide_batch() {
  costs_.broad.start();
  const auto append = [](void* self, dGeomID, dGeomID, const dContactGeom* contacts, int count) {
    auto& all = static_cast<GrainWorld*>(self)->contacts_;
    all.insert(all.end(), contacts, contacts + count);
  };
  if (snBatchCollide(batch_, space_, kContactsPerPair, this, name_pair, append) < 0) throw std::runtime_error(snLastError());
  costs_.narrow.start_where_ended(costs_.broad);
  costs_.narrow.lap();
}

int GrainWorld::name_pair(void* self, dGeomID g1, dGeomID g2) {
  auto& world = *static_cast<GrainWorld*>(self);
  world.pairs_.emplace_back(g1, g2);
  world.costs_.broad.lap();  // the last pair from ODE ends the broad phase
  return 1;
}

void GrainWorld::make_joints() {
  costs_.refused += std::erase_if(contacts_, [](const dContactGeom& contact) { return !is_unit(contact.normal); });
  joints_.replace(contacts_);
}

Snapshot GrainWorld::snapshot() const {
  Snapshot snapshot;
  snapshot.placements.reserve(kinds_.size());
  snapshot.velocities.reserve(kinds_.size());
  for (std::size_t i = 0; i < kinds_.size(); ++i) {
    const falling_particles::Grain& body = world_.grains()[i];
    const dReal* const v = dBodyGetLinearVel(body.body);
    const dReal* const w = dBodyGetAngularVel(body.body);
    snapshot.placements.push_back({kinds_[i], body.position(), body.quaternion()});
    snapshot.velocities.push_back({v[0], v[1], v[2], w[0], w[1], w[2]});
  }
  return snapshot;
}

}  // namespace scene_cost
