#include "stepper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>
#include <variant>

#include "grain.hpp"
#include "model/wall.hpp"

namespace falling_particles {
namespace {

/// The contacts of two walls that are asked for. ODE finds those of a mesh in the order of its vertices, and the first few may be
/// on one side of a large face. A plate of 10 cm, a mesh with 1024 vertices on its lower side, tilts by 0.05 degrees on a plane
/// with 64 of them, and not with 256 or 1024. A step on a box, which finds more than 1024, takes 1.7, 3.8 and 8.2 ms.
constexpr int kContactsOfWalls = 256;

/// Moves the deepest contact to the front and behind it, one after the other, those farthest from the contacts before them. Returns
/// the first `most`.
std::span<dContactGeom> spread_contacts(std::span<dContactGeom> contacts, std::size_t most) {
  const auto distance = [](const dContactGeom& a, const dContactGeom& b) { return (to_vector(a.pos) - to_vector(b.pos)).norm(); };
  const std::size_t count = std::min(most, contacts.size());
  for (std::size_t kept = 0; kept < count; ++kept) {
    const auto rank = [&](const dContactGeom& contact) -> double {
      if (kept == 0) return contact.depth;
      double nearest = INFINITY;
      for (const dContactGeom& other : contacts.first(kept)) nearest = std::min(nearest, distance(contact, other));
      return nearest;
    };
    std::swap(contacts[kept], *std::ranges::max_element(contacts.subspan(kept), {}, rank));
  }
  return contacts.first(count);
}

bool is_awake(dGeomID geom) {
  const dBodyID body = dGeomGetBody(geom);
  return body != nullptr && dBodyIsEnabled(body) != 0;
}

WallPose pose_of(dBodyID body) {
  const dReal* const q = dBodyGetQuaternion(body);
  return {to_vector(dBodyGetPosition(body)), Eigen::Quaterniond(q[0], q[1], q[2], q[3])};
}

bool may_sleep(const Scene& scene) {
  return std::ranges::any_of(scene.effects,
                             [](const auto& effect) { return std::holds_alternative<supernormal::effects::AutoDisable>(effect); });
}

/// Whether the geom is a moving wall. A grain on it stays awake: ODE would regard a slow grain as idle and disable it.
bool is_moving_wall(dGeomID geom, const supernormal::effects::Side& side) {
  return grain_of(geom) == nullptr && side.body != nullptr;
}

/// Makes the joint enforce this velocity (m/s) of the first body relative to the second. Its directions are the friction directions
/// of the effects or, without them, of ODE.
void set_relative_velocity(dContact& contact, const Vector3& velocity) {
  dVector3 first, second;
  if ((contact.surface.mode & dContactFDir1) == 0) {
    dPlaneSpace(contact.geom.normal, first, second);
    std::copy_n(first, 3, contact.fdir1);
  }
  const Vector3 normal = to_vector(contact.geom.normal);
  const Vector3 along = to_vector(contact.fdir1);
  // The effects may set a velocity along the normal, relative to the wall: springs and speculative contacts do.
  const double asked = (contact.surface.mode & dContactMotionN) != 0 ? double{contact.surface.motionN} : 0;
  contact.surface.mode |= dContactFDir1 | dContactMotion1 | dContactMotion2 | dContactMotionN;
  contact.surface.motion1 = along.dot(velocity);
  contact.surface.motion2 = normal.cross(along).dot(velocity);
  contact.surface.motionN = asked + normal.dot(velocity);
}

bool are_walls(dGeomID g1, dGeomID g2) { return grain_of(g1) == nullptr && grain_of(g2) == nullptr; }

/// m/s, the velocity of the first body relative to the second one that two bodies need in a step (s) besides equal velocities at
/// their contact, along its surface, because the contact is elsewhere in the middle of the step. It is taken to move as the mean of
/// both centres. Two bodies that ride on each other turn with one angular velocity; then the place does not matter, and they follow
/// the chord of the turn. What they move along the normal is left out, since an impact ends within the step.
Vector3 excess_of_riders(dBodyID body1, dBodyID body2, const Vector3& normal, double step) {
  const double turn = normal.dot(to_vector(dBodyGetAngularVel(body1)) + to_vector(dBodyGetAngularVel(body2)));
  return step / 4 * turn * normal.cross(to_vector(dBodyGetLinearVel(body1)) - to_vector(dBodyGetLinearVel(body2)));
}

bool is_same_pair(const dContactGeom& a, const dContactGeom& b) { return a.g1 == b.g1 && a.g2 == b.g2; }

}  // namespace

Stepper::Stepper(const World& world, const Scene& scene, int threads)
    : world_(world),
      step_(scene.time.step),
      may_sleep_(may_sleep(scene)),
      joints_(world),
      joints_of_walls_(world),
      batch_(snBatchCreate(threads)) {
  if (batch_ == nullptr) throw std::runtime_error(snLastError());
  world_.effects().measure();
}

Stepper::~Stepper() { snBatchDestroy(batch_); }

void Stepper::step(bool measures) {
  starts_.clear();
  if (world_.stepper() != nullptr) {
    for (const Grain& grain : world_.present()) starts_.push_back(pose_of(grain.body));
  }
  for (double done = 0; done < step_;) done = make_part(done, measures);
  auto start = starts_.begin();
  if (world_.stepper() == nullptr) return;
  for (const Grain& grain : world_.present()) *move_by_stepper(grain.body) = mean_velocity(*start++, pose_of(grain.body), step_);
}

/// Makes the step from `done` (s) on, and returns when it ended: at the step, or before.
double Stepper::make_part(double done, bool measures) {
  const bool is_first = done == 0;
  contacts_.clear();
  world_.walls().before_step(done);
  if (PeriodicCell* cell = world_.cell()) cell->place_images();
  world_.sweep().before_step();
  {
    const Stopwatch::Lap lap(costs_.collision);
    collide_grains();
    sort_contacts();
    collide_with_walls();
    collide_free_walls();
    if (Bonds* bonds = world_.bonds()) bonds->reduce(contacts_);
  }
  {
    const Stopwatch::Lap lap(costs_.contact_setup);
    is_first ? joints_.replace(contacts_, measures) : joints_.add(contacts_, measures);
    joints_of_walls_.replace(contacts_of_walls_);
    if (is_first) world_.effects().apply_forces();  // they act for the whole step
    if (PeriodicCell* cell = world_.cell(); cell != nullptr && world_.scene().looks_ahead()) cell->share_ways();
  }
  if (Bonds* bonds = world_.bonds()) {
    const Stopwatch::Lap lap(costs_.bonds);
    bonds->before_step();
  }
  ++costs_.parts;
  costs_.contacts += contacts_.size();
  costs_.contacts_of_walls += contacts_of_walls_.size();
  costs_.rows_of_walls += static_cast<unsigned long long>(world_.walls().rows());
  for (const dContactGeom& contact : contacts_) {
    deepest_contact_ = std::max<double>(deepest_contact_, contact.depth);
    if (contact.depth < 0) ++costs_.contacts_ahead;
  }
  {
    const Stopwatch::Lap lap(costs_.solver);
    const double left = step_ - done;
    const double made = solve(left);
    done = made < left ? done + made : step_;
    if (PeriodicCell* cell = world_.cell()) cell->gather();
    world_.walls().after_step(done);
  }
  if (Bonds* bonds = world_.bonds()) {
    const Stopwatch::Lap lap(costs_.bonds);
    bonds->after_step();
  }
  return done;
}

/// Returns the time done, s.
double Stepper::solve(double time) {
  if (world_.stepper() == nullptr) {
    dWorldQuickStep(world_.id(), time);
    return time;
  }
  const double done = world_.stepper()->step(time);
  joints_.read_forces(done / step_);
  return done;
}

void Stepper::collide_grains() {
  costs_.broad_phase.start();
  if (snBatchCollide(batch_, world_.sweep().id(), kContactsPerPair, this, &Stepper::name_pair, &Stepper::add_contacts) < 0) {
    throw std::runtime_error(snLastError());
  }
}

// Pairs with walls collide on one thread, since ODE's meshes and heightfields are not thread-safe.
void Stepper::collide_with_walls() {
  wall_pairs_.clear();
  {
    const Stopwatch::Lap lap(costs_.broad_phase);
    world_.name_wall_pairs(this, [](void* self, dGeomID g1, dGeomID g2) {
      auto& stepper = *static_cast<Stepper*>(self);
      if (name_pair(self, g1, g2) != 0) stepper.wall_pairs_.emplace_back(g1, g2);
    });
  }
  for (const auto& [grain, wall] : wall_pairs_) {
    std::array<dContactGeom, kContactsPerPair> found;
    add_contacts(this, grain, wall, found.data(), dCollide(grain, wall, kContactsPerPair, found.data(), sizeof(dContactGeom)));
  }
}

void Stepper::collide_free_walls() {
  contacts_of_walls_.clear();
  for (const auto& [g1, g2] : world_.walls().pairs_of_free()) {
    std::array<dContactGeom, kContactsOfWalls> found;
    const auto count = static_cast<std::size_t>(dCollide(g1, g2, kContactsOfWalls, found.data(), sizeof(dContactGeom)));
    const auto spread = spread_contacts(std::span(found).first(count), kContactsPerPair);
    contacts_of_walls_.insert(contacts_of_walls_.end(), spread.begin(), spread.end());
  }
}

// Sorts contacts by their bodies. The sweep names pairs in their order along its axis. The first iterations of quickstep take
// contacts in the order of their joints. Unsorted, they carry forces along the axis better than against it.
void Stepper::sort_contacts() {
  const auto bodies = [](const dContactGeom& contact) -> std::pair<const Grain*, const Grain*> {
    return std::minmax(grain_of(contact.g1), grain_of(contact.g2));
  };
  // Images of two bodies may meet, too. A stable sort keeps the contacts of each pair of geoms together.
  std::ranges::stable_sort(contacts_, [&bodies](const dContactGeom& a, const dContactGeom& b) { return bodies(a) < bodies(b); });
}

int Stepper::name_pair(void* self, dGeomID g1, dGeomID g2) {
  auto& stepper = *static_cast<Stepper*>(self);
  if (stepper.world_.sweep().is_end_marker(g1)) {
    stepper.costs_.broad_phase.lap();
    return 0;
  }
  if (stepper.may_sleep_ && !is_awake(g1) && !is_awake(g2)) {
    if (grain_of(g2) != nullptr || !stepper.world_.walls().is_moving(g2)) return 0;
  }
  if (const Bonds* bonds = stepper.world_.bonds(); bonds != nullptr && bonds->hide(g1, g2)) return 0;
  ++stepper.costs_.pairs_tested;
  return 1;
}

void Stepper::add_contacts(void* self, dGeomID /*g1*/, dGeomID /*g2*/, const dContactGeom* contacts, int count) {
  Stepper& stepper = *static_cast<Stepper*>(self);
  const PeriodicCell* cell = stepper.world_.cell();
  for (const dContactGeom& contact : std::span(contacts, static_cast<std::size_t>(count))) {
    if (cell == nullptr || cell->contains(contact.pos)) stepper.contacts_.push_back(contact);
  }
}

// ODE reports the force on the joint's first body. This is the body of g2 when g1 has none.
Point MeasuredContact::force() const {
  const double sign = is_reversed ? -1 : 1;
  return {sign * feedback.f1[0], sign * feedback.f1[1], sign * feedback.f1[2]};
}

ContactJoints::ContactJoints(const World& world) : world_(world), joints_(dJointGroupCreate(0)) {}

ContactJoints::~ContactJoints() { dJointGroupDestroy(joints_); }

void ContactJoints::replace(std::span<const dContactGeom> contacts, bool measures) {
  dJointGroupEmpty(joints_);
  measured_.clear();
  read_ = 0;
  add(contacts, measures);
}

void ContactJoints::add(std::span<const dContactGeom> contacts, bool measures) {
  for (std::size_t first = 0, end = 0; first < contacts.size(); first = end) {
    while (end < contacts.size() && is_same_pair(contacts[first], contacts[end])) ++end;
    attach(contacts.subspan(first, end - first), measures);
  }
}

void ContactJoints::read_forces(double part) {
  for (int number = 0; read_ < measured_.size(); ++read_, ++number) {
    const Vector3 force = part * world_.stepper()->contact_force(number);
    std::copy_n(force.data(), 3, measured_[read_].feedback.f1);
  }
}

void ContactJoints::attach(std::span<const dContactGeom> pair, bool measures) {
  std::array<dContact, kContactsPerPair> room;
  const auto contacts = std::span(room).first(pair.size());
  for (std::size_t i = 0; i < pair.size(); ++i) contacts[i].geom = pair[i];
  const auto [geom1, geom2] = std::pair{pair[0].g1, pair[0].g2};
  Side side1 = side_of(geom1);
  const Side side2 = side_of(geom2);
  if (are_walls(geom1, geom2)) {
    side1.material = kGrainMaterial;  // a free wall meets the other one as grains do
  } else {
    if (is_moving_wall(geom1, side1)) dBodyEnable(side2.body);
    if (is_moving_wall(geom2, side2)) dBodyEnable(side1.body);
  }
  const int count = world_.effects().set_up_contacts(contacts, side1, side2);
  const auto kept = contacts.first(static_cast<std::size_t>(count));
  if (world_.stepper() == nullptr) follow_chords(kept, side1, side2);  // the stepper's contacts follow a wall that turns
  for (const dContact& contact : kept) {
    if (world_.stepper() != nullptr) {
      world_.stepper()->add_contact(contact, side1.body, side2.body);
      if (measures) measured_.push_back({contact.geom, {}});
      continue;
    }
    const dJointID joint = dJointCreateContact(world_.id(), joints_, &contact);
    dJointAttach(joint, side1.body, side2.body);
    if (measures) measure(joint, contact, side1.body == nullptr);
  }
}

ContactJoints::Side ContactJoints::side_of(dGeomID geom) const {
  if (grain_of(geom) != nullptr) return {kGrainMaterial, dGeomGetBody(geom)};
  return world_.walls().side_of(geom);
}

void ContactJoints::follow_chords(std::span<dContact> contacts, const Side& side1, const Side& side2) const {
  if (contacts.empty()) return;
  const dContactGeom& geom = contacts.front().geom;
  const bool is_grain1 = grain_of(geom.g1) != nullptr;
  const bool is_grain2 = grain_of(geom.g2) != nullptr;
  if (is_grain1 && is_grain2) {
    // All contacts of the pair ask for one velocity.
    const Vector3 excess = excess_of_riders(side1.body, side2.body, to_vector(geom.normal), world_.scene().time.step);
    if (excess.isZero(0)) return;
    for (dContact& contact : contacts) set_relative_velocity(contact, excess);
    return;
  }
  // Of two walls the first is free, and rides.
  const bool is_rider_first = is_grain1 || !is_grain2;
  const auto [rider, wall] = is_rider_first ? std::pair{side1.body, side2.body} : std::pair{side2.body, side1.body};
  if (rider == nullptr || wall == nullptr) return;
  const Vector3 excess = world_.walls().chord_excess(is_rider_first ? geom.g2 : geom.g1, to_vector(dBodyGetPosition(rider)),
                                                     to_vector(dBodyGetLinearVel(rider)));
  if (excess.isZero(0)) return;
  for (dContact& contact : contacts) set_relative_velocity(contact, is_rider_first ? excess : Vector3(-excess));
}

void ContactJoints::measure(dJointID joint, const dContact& contact, bool is_reversed) {
  dJointSetFeedback(joint, &measured_.emplace_back(MeasuredContact{contact.geom, {}, is_reversed}).feedback);
}

}  // namespace falling_particles
