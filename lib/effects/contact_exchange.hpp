// Contact joints in place of those that a program has attached.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace supernormal::effects {

/// ODE has no function that changes a contact joint. So a joint is disabled, and another one takes its place for one step.
class ContactExchange {
 public:
  /// Numbers of a program's contacts: those of all contacts between two bodies, and the first one and the number of those meant.
  struct Place {
    dBodyID body1, body2;  ///< one of them may be 0, a wall
    std::size_t all, first, count;
  };

  /// Removes the joints of the last step.
  void clear();

  /// Replaces a program's contacts. If it has not attached as many contacts as were set up, it is unknown which is which. Then no
  /// contact is replaced.
  void replace(const Place& place, std::span<const dContact> contacts);

  /// Adds contacts that a program has not attached.
  void add(std::span<const dContact> contacts, dBodyID body1, dBodyID body2) {
    for (const dContact& contact : contacts) exchanges_.push_back({nullptr, contact, body1, body2});
  }

  /// Makes the joints.
  void commit();

 private:
  struct Exchange {
    dJointID old;
    dContact contact;
    dBodyID body1, body2;
  };
  struct Destroy {
    void operator()(dJointGroupID group) const { dJointGroupDestroy(group); }
  };
  std::vector<Exchange> exchanges_;
  bool is_possible_ = true;
  std::unique_ptr<std::remove_pointer_t<dJointGroupID>, Destroy> joints_{dJointGroupCreate(0)};
};

}  // namespace supernormal::effects
