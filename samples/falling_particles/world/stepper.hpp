// The steps of a simulation.
#pragma once

#include <ode/ode.h>
#include <supernormal/supernormal.h>

#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "common/stopwatch.hpp"
#include "model/scene.hpp"
#include "world.hpp"

namespace falling_particles {

/// max_contacts of a pair: four points support a face on a face, and the deepest point is the fifth.
inline constexpr int kContactsPerPair = 5;

/// A contact with its force.
struct MeasuredContact {
  dContactGeom geom;
  dJointFeedback feedback;   ///< by the stepper, only f1
  bool is_reversed = false;  ///< whether the joint's first body is the body of geom.g2

  /// N, in the world's frame, on the body of geom.g1; valid after the step.
  Point force() const;
};

/// The contact joints of a step in a world, which must outlive them; or the contacts that its stepper takes in their place.
class ContactJoints {
 public:
  explicit ContactJoints(const World& world);
  ~ContactJoints();
  ContactJoints(const ContactJoints&) = delete;
  ContactJoints(ContactJoints&&) = delete;
  ContactJoints& operator=(const ContactJoints&) = delete;
  ContactJoints& operator=(ContactJoints&&) = delete;

  /// Replaces the joints of the last step by joints for `contacts`, as the effects of the world set them up. The contacts of a
  /// pair, at most kContactsPerPair, must be consecutive. Of two walls the first is free; it has the friction and restitution of
  /// grains on the second. If `measures`, measured() has their forces after the next step.
  void replace(std::span<const dContactGeom> contacts, bool measures = false);
  /// Adds further contacts, of the rest of a step that ended early.
  void add(std::span<const dContactGeom> contacts, bool measures = false);
  /// After the stepper has made the fraction `part` of a step: the measured forces are means over the step. The contacts must be
  /// the first ones that the stepper was given.
  void read_forces(double part);

  /// The contacts that the effects have kept, in the order of their pairs; of a step that ended early, part by part. Empty if
  /// `measures` was false.
  const std::deque<MeasuredContact>& measured() const { return measured_; }

 private:
  using Side = supernormal::effects::Side;

  void attach(std::span<const dContactGeom> pair, bool measures);
  Side side_of(dGeomID geom) const;
  void follow_chords(std::span<dContact> contacts, const Side& side1, const Side& side2) const;
  void measure(dJointID joint, const dContact& contact, bool is_reversed);

  const World& world_;
  dJointGroupID joints_;
  std::deque<MeasuredContact> measured_;  // the joints point to its elements, which a deque does not move
  std::size_t read_ = 0;                  // how many of them have their force, by the stepper
};

/// The time and the amount of work of all steps.
struct StepCosts {
  Stopwatch collision;      ///< broad and narrow phase
  Stopwatch broad_phase;    ///< bounding boxes and pairs; part of collision
  Stopwatch contact_setup;  ///< passes of the effects, creation and removal of contact joints
  Stopwatch solver;         ///< dWorldQuickStep, or the stepper
  Stopwatch bonds;          ///< forces and breaks of bonds, without their rows in the solver
  unsigned long long pairs_tested = 0;
  unsigned long long parts = 0;  ///< of steps: more than steps where the stepper ended some early
  unsigned long long contacts = 0;
  unsigned long long contacts_ahead = 0;     ///< of these, ahead of touch
  unsigned long long contacts_of_walls = 0;  ///< between two walls
  unsigned long long rows_of_walls = 0;      ///< of the joints of driven walls
  double narrow_phase_seconds() const { return collision.seconds() - broad_phase.seconds(); }
  void serialize(auto& archive) {
    archive(collision, broad_phase, contact_setup, solver, bonds, pairs_tested, parts, contacts, contacts_ahead, contacts_of_walls,
            rows_of_walls);
  }
};

/// Advances a world by steps. A step finds contacts, makes them constraints, and integrates. A step of the scene's stepper may end
/// early: then the same is done for the rest of it.
class Stepper {
 public:
  /// `threads`, in [1, 256], find contacts; 0: as many as the machine has. The motion does not depend on their number.
  Stepper(const World& world, const Scene& scene, int threads = 1);
  ~Stepper();
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// If `measures`, measured_contacts() has the forces of this step. The motion is the same.
  void step(bool measures = false);

  std::size_t contacts() const { return contacts_.size(); }                     ///< number of contacts in the last step
  const std::vector<dContactGeom>& contact_geoms() const { return contacts_; }  ///< contacts of the last step, or of its last part
  /// The contacts of the last step with their forces, if it measured them.
  const std::deque<MeasuredContact>& measured_contacts() const { return joints_.measured(); }
  double deepest_contact() const { return deepest_contact_; }  ///< m, over all steps
  const StepCosts& costs() const { return costs_; }

  /// Saves or restores the results of the steps so far, but not the contacts of the last one.
  void serialize(auto& archive) { archive(deepest_contact_, costs_); }

 private:
  double make_part(double done, bool measures);
  double solve(double time);
  void collide_grains();
  void collide_with_walls();
  void collide_free_walls();
  void sort_contacts();
  static int name_pair(void* self, dGeomID g1, dGeomID g2);
  static void add_contacts(void* self, dGeomID g1, dGeomID g2, const dContactGeom* contacts, int count);

  const World& world_;
  double step_;
  bool may_sleep_;  // if true, pairs without an awake body are skipped
  ContactJoints joints_;
  ContactJoints joints_of_walls_;  // between free walls and other walls, which no measurement counts
  snBatchID batch_;
  std::vector<std::pair<dGeomID, dGeomID>> wall_pairs_;
  std::vector<dContactGeom> contacts_;
  std::vector<dContactGeom> contacts_of_walls_;
  std::vector<WallPose> starts_;  // of the present grains, if the stepper moves them
  double deepest_contact_ = 0;
  StepCosts costs_;
};

}  // namespace falling_particles
