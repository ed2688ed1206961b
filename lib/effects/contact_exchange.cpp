#include "effects/contact_exchange.hpp"

namespace supernormal::effects {
namespace {

/// The contact joints between two bodies, in the order in which they were attached: ODE lists the last one first.
std::vector<dJointID> contact_joints(dBodyID body, dBodyID other) {
  std::vector<dJointID> joints;
  for (int k = dBodyGetNumJoints(body); k-- > 0;) {
    const dJointID joint = dBodyGetJoint(body, k);
    if (dJointGetType(joint) != dJointTypeContact) continue;
    if (dJointGetBody(joint, dJointGetBody(joint, 0) == body ? 1 : 0) == other) joints.push_back(joint);
  }
  return joints;
}

}  // namespace

void ContactExchange::clear() { dJointGroupEmpty(joints_.get()); }

void ContactExchange::replace(const Place& place, std::span<const dContact> contacts) {
  const bool is_first = place.body1 != nullptr;
  const std::vector<dJointID> joints = contact_joints(is_first ? place.body1 : place.body2, is_first ? place.body2 : place.body1);
  if (joints.size() != place.all) is_possible_ = false;
  for (std::size_t k = 0; is_possible_ && k < place.count; ++k)
    exchanges_.push_back({joints[place.first + k], contacts[k], place.body1, place.body2});
}

void ContactExchange::commit() {
  if (!is_possible_) exchanges_.clear();
  for (const Exchange& exchange : exchanges_) {
    const dBodyID body = exchange.body1 != nullptr ? exchange.body1 : exchange.body2;
    const dJointID joint = dJointCreateContact(dBodyGetWorld(body), joints_.get(), &exchange.contact);
    dJointAttach(joint, exchange.body1, exchange.body2);
    if (exchange.old == nullptr) continue;
    dJointDisable(exchange.old);
    dJointSetFeedback(joint, dJointGetFeedback(exchange.old));
  }
  exchanges_.clear();
  is_possible_ = true;
}

}  // namespace supernormal::effects
