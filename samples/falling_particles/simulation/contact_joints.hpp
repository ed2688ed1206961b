// The contact joints of a step.
#pragma once

#include <ode/ode.h>

#include <span>

#include "world.hpp"

namespace falling_particles {

/// The most contacts that a pair may ask for: a face on a face is held by four points and the deepest one.
inline constexpr int kContactsPerPair = 5;

/// The contacts of a step as joints of a world, which must outlive them.
class ContactJoints {
 public:
  explicit ContactJoints(const World& world);
  ~ContactJoints();
  ContactJoints(const ContactJoints&) = delete;
  ContactJoints(ContactJoints&&) = delete;
  ContactJoints& operator=(const ContactJoints&) = delete;
  ContactJoints& operator=(ContactJoints&&) = delete;

  /// Replaces the joints of the last step by those for `contacts`, as the effects of the world set them up. The contacts of a
  /// pair, at most kContactsPerPair, are consecutive.
  void replace(std::span<const dContactGeom> contacts);

 private:
  void attach(std::span<const dContactGeom> pair);

  const World& world_;
  dJointGroupID joints_;
};

}  // namespace falling_particles
