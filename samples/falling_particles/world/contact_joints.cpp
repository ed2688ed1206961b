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
