#include "contact_joints.hpp"

#include <array>

namespace falling_particles {
namespace {

bool is_same_pair(const dContactGeom& a, const dContactGeom& b) { return a.g1 == b.g1 && a.g2 == b.g2; }

}  // namespace

// ODE tells the force on the joint's first body, which is that of g2 when g1 has none.
Point MeasuredContact::force() const {
  const double sign = dGeomGetBody(geom.g1) == nullptr ? -1 : 1;
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
  std::array<dContact, kContactsPerPair> contacts;
  for (std::size_t i = 0; i < pair.size(); ++i) contacts[i].geom = pair[i];
  const int count =
      world_.effects().set_up_contacts(std::span(contacts).first(pair.size()), material_of(pair[0].g1), material_of(pair[0].g2));
  for (int i = 0; i < count; ++i) {
    const dContact& contact = contacts[static_cast<std::size_t>(i)];
    const dJointID joint = dJointCreateContact(world_.id(), joints_, &contact);
    dJointAttach(joint, dGeomGetBody(contact.geom.g1), dGeomGetBody(contact.geom.g2));
    if (measures) dJointSetFeedback(joint, &measured_.emplace_back(MeasuredContact{contact.geom, {}}).feedback);
  }
}

}  // namespace falling_particles
