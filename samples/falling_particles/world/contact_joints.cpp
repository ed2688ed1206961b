#include "contact_joints.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "model/material.hpp"
#include "to_vector.hpp"

namespace falling_particles {
namespace {

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

bool is_same_pair(const dContactGeom& a, const dContactGeom& b) { return a.g1 == b.g1 && a.g2 == b.g2; }

}  // namespace

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
  for (std::size_t first = 0, end = 0; first < contacts.size(); first = end) {
    while (end < contacts.size() && is_same_pair(contacts[first], contacts[end])) ++end;
    attach(contacts.subspan(first, end - first), measures);
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
  follow_chords(kept, side1, side2);
  for (const dContact& contact : kept) {
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
  const bool is_wall_first = grain_of(geom.g1) == nullptr;
  if (are_walls(geom.g1, geom.g2)) return;
  if ((is_wall_first ? side1 : side2).body == nullptr || (!is_wall_first && grain_of(geom.g2) != nullptr)) return;
  const dBodyID grain = (is_wall_first ? side2 : side1).body;
  const Vector3 excess = world_.walls().chord_excess(is_wall_first ? geom.g1 : geom.g2, to_vector(dBodyGetPosition(grain)),
                                                     to_vector(dBodyGetLinearVel(grain)));
  if (excess.isZero(0)) return;
  for (dContact& contact : contacts) set_relative_velocity(contact, is_wall_first ? Vector3(-excess) : excess);
}

void ContactJoints::measure(dJointID joint, const dContact& contact, bool is_reversed) {
  dJointSetFeedback(joint, &measured_.emplace_back(MeasuredContact{contact.geom, {}, is_reversed}).feedback);
}

}  // namespace falling_particles
