// A step that remembers its contact forces, in place of dWorldQuickStep.
#pragma once

#include <ode/ode.h>

#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "stepper/contact.hpp"
#include "stepper/joint.hpp"
#include "stepper/memory.hpp"
#include "stepper/moving_contacts.hpp"
#include "stepper/sub_steps.hpp"
#include "stepper/sweep.hpp"

namespace supernormal::stepper {

/// All functions throw std::invalid_argument for a bad argument, and then change nothing.
class Stepper {
 public:
  /// A world has one stepper: each calls dWorldQuickStep, which moves all other bodies.
  explicit Stepper(dWorldID world);

  void add_body(dBodyID body);
  void remove_body(dBodyID body);
  void add_contact(const dContact& contact, dBodyID body1, dBodyID body2);
  void set_accuracy(const Accuracy& accuracy) { sub_steps_.accuracy = accuracy; }

  /// The time done, s: less than `time` if bodies have left the paths that their contacts were found for.
  double step(double time);

  /// Whether the last step moved a body itself, and quickstep did not.
  bool moves(dBodyID moved) const { return !body(index_of("body", moved)).is_held; }

  std::vector<double> save(std::span<const dGeomID> geoms) const;
  void load(std::span<const dGeomID> geoms, std::span<const double> numbers);

  /// N; on body 1, the mean over the last step. The number counts the contacts of that step in the order in which they were added.
  const Vector3& contact_force(int contact) const;

 private:
  int index_of(const char* name, dBodyID body) const;
  std::size_t index_of(const Contact& contact) const { return std::size_t(contact.given - given_.data()); }
  Body& body(int index) { return system_.bodies[static_cast<std::size_t>(index)]; }
  const Body& body(int index) const { return system_.bodies[static_cast<std::size_t>(index)]; }
  bool is_of_quickstep(const Given& given) const;
  void read_bodies(bool is_rest);
  enum class Along { Joints, All };
  void spread(bool Body::*property, bool Body::*source, Along along = Along::All);
  void set_up_contacts(double time);
  void soften(double sub_step);
  void centre();
  void sub_step(int number, SweepSettings settings);
  void keep_forces(double time);
  void step_others(double planned, double time);
  void let_sleep(double time);

  struct Release {
    void operator()(dWorldID world) const;  // another stepper may have it
    void operator()(dJointGroupID joints) const { dJointGroupDestroy(joints); }
  };
  std::unique_ptr<dxWorld, Release> world_;
  std::unique_ptr<dxJointGroup, Release> contact_joints_;  // of bodies that quickstep moves
  System system_;
  std::unordered_map<dBodyID, int> indices_;  // in system_.bodies
  std::vector<Given> given_;
  Memory memory_;
  Joints joints_;
  MovingContacts moving_;
  SubSteps sub_steps_;
  std::vector<dBodyID> stopped_;  // while quickstep moves the others
  std::vector<Vector3> forces_;   // N, of the contacts of the last step
  double whole_ = 0;              // s; the step of which `left_` is the rest
  double left_ = 0;               // s; after a step that ended early
  Softness softness_;             // of contacts without one of their own
};

}  // namespace supernormal::stepper
