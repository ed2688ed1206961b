// Speculative contacts: contacts of bodies that do not touch yet, and the impacts of a step, one after the other.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <memory>
#include <span>
#include <tuple>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "effects/meeting.hpp"

namespace supernormal::effects {

class SpeculativeSetup {
 public:
  /// `step`: s. `is_elastic`: whether any bodies bounce. `pairs` outlive it.
  SpeculativeSetup(double step, bool is_elastic, PairMaterials& pairs) : step_(step), is_elastic_(is_elastic), pairs_(pairs) {}

  /// Whether the bodies overlap at an impact, because a joint holds one of them, which is not moved to touch.
  bool lets_in(const PairMaterial& pair, dBodyID body1, dBodyID body2);

  /// Turns the contacts of one pair with negative depths into constraints on the motion of the step: their gaps may close, or the
  /// bodies bounce. The contacts are all that will be attached, in this order.
  void set_up(const PairMaterial& pair, std::span<dContact> contacts, const Side& side1, const Side& side2);

  /// Lets the impacts of the step happen, in the order of their times: moves bodies to touch, and replaces the contacts of bodies
  /// that have more than one impact.
  void resolve();

  /// Drops the contacts of a body.
  void remove(dBodyID body);

 private:
  /// What was set up in one call.
  struct Record {
    const PairMaterial* pair;
    std::size_t body1, body2;  // in bodies_
    std::size_t first, count;  // in contacts_; none if the pair cannot bounce
    std::size_t attached;      // contacts that the program attaches; 0 for a wall that was found after impacts
    bool may_bounce = false;
    bool is_planned = false;  // whether there is an impact if no other body comes in between
    int impacts = 0;
  };

  std::size_t index_of(dBodyID body);
  Meeting meeting(const Record& record) {
    return {*record.pair, bodies_[record.body1], bodies_[record.body2], std::span(contacts_).subspan(record.first, record.count),
            step_,        record.may_bounce};
  }
  void set_up_alone(Record& record, std::span<dContact> contacts);
  void list_record(std::size_t index);
  void expect(std::size_t index);
  void run_impacts();
  /// What a search for walls needs: of one body, and whether it bounces there or stops.
  struct Search {
    SpeculativeSetup* setup;
    std::size_t body;
    bool bounces;
  };
  /// Material -1, which none is, for a geom that met nothing in this step.
  Side side_of(dGeomID geom) const;
  void find_walls(std::size_t index);
  static void add_wall(void* data, dGeomID geom1, dGeomID geom2);
  bool is_struck(std::size_t index);
  bool bounce_middle(std::size_t index);
  bool stop_at_walls(std::size_t index);
  void exchange(std::size_t index);
  void make_joints();
  void move_bodies() const;

  double step_;
  bool is_elastic_;
  PairMaterials& pairs_;
  using Met = std::pair<dGeomID, Side>;
  std::vector<Met> sides_;                            // of the geoms that met in this step
  std::vector<Record> records_;                       // of this step
  std::vector<std::vector<std::size_t>> records_of_;  // of each body that moves, in records_
  std::vector<MeetingContact> contacts_;
  std::vector<MeetingContact> alone_;  // of the present call
  std::vector<Push> pushes_;           // of the present impact
  std::vector<dContact> rows_;         // of the present pair
  std::vector<MovingBody> bodies_;
  std::unordered_map<dBodyID, std::size_t> indices_;   // also of earlier steps
  using Event = std::tuple<double, std::size_t, int>;  // time, record, and the impacts that its bodies had
  std::vector<Event> events_;                          // a heap, the first one on top
  /// ODE has no function that changes a contact joint. So one is disabled, and another one takes its place for one step.
  struct Exchange {
    dJointID old;  // null for a contact that a program has not attached
    dContact contact;
    dBodyID body1, body2;
  };
  struct Destroy {
    void operator()(dJointGroupID group) const { dJointGroupDestroy(group); }
  };
  std::vector<Exchange> exchanges_;
  std::vector<dJointID> listed_;  // between the present bodies
  bool is_known_ = true;          // which joint is which contact
  std::unique_ptr<std::remove_pointer_t<dJointGroupID>, Destroy> joints_{dJointGroupCreate(0)};
};

}  // namespace supernormal::effects
