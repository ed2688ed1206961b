// Speculative contacts: contacts of bodies that do not touch yet, and the impacts of a step, one after the other.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <span>
#include <unordered_map>
#include <vector>

#include "effects/contact_exchange.hpp"
#include "effects/meeting.hpp"

namespace supernormal::effects {

class SpeculativeSetup {
 public:
  /// `step`: s. `is_elastic`: whether any bodies bounce.
  SpeculativeSetup(double step, bool is_elastic) : step_(step), is_elastic_(is_elastic) {}

  /// Whether the bodies overlap at an impact, because a joint holds one of them, which is not moved to touch.
  bool lets_in(const PairMaterial& pair, dBodyID body1, dBodyID body2);

  /// Turns the contacts of one pair with negative depths into constraints on the motion of the step: their gaps may close, or the
  /// bodies bounce. The contacts are all that will be attached, in this order.
  void set_up(const PairMaterial& pair, std::span<dContact> contacts, dBodyID body1, dBodyID body2);

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
    dGeomID geom1, geom2;
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
  void list_records();
  void run_impacts();
  /// What a search for walls needs: of one body, with the pair that struck it, and whether it bounces there or stops.
  struct Search {
    SpeculativeSetup* setup;
    std::size_t body;
    const PairMaterial* pair;
    bool bounces;
  };
  void find_walls();
  static void add_wall(void* data, dGeomID geom1, dGeomID geom2);
  void exchange(std::size_t index);
  void move_bodies() const;

  double step_;
  bool is_elastic_;
  std::vector<Record> records_;                       // of this step
  std::vector<std::vector<std::size_t>> records_of_;  // of each body that moves, in records_
  std::vector<MeetingContact> contacts_;
  std::vector<MeetingContact> alone_;  // of the present call
  std::vector<MovingBody> bodies_;
  std::unordered_map<dBodyID, std::size_t> indices_;
  ContactExchange joints_;
};

}  // namespace supernormal::effects
