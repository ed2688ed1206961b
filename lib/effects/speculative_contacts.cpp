// The impacts of a step happen one after the other, each between two bodies, so an impact does not act through a third body that
// touches. Newton's cradle does this, and ODE's solver does not: there an impact meets contacts that do not approach yet, which
// demand no bounce.
//
// The solver gets the velocities after the last impact. Each impulse of the sequence changes these velocities along the normal of
// a contact, and the contact demands the velocity that results there. So the sum of the impulses is the force of the solver, and
// friction and the force that a program measures are as large as it.
#include "effects/speculative_contacts.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "effects/motion.hpp"
#include "ode/geom/body.hpp"
#include "ode/geom/bounding_box.hpp"
#include "ode/geom/convert.hpp"
#include "ode/geom/look_ahead.hpp"

namespace supernormal::effects {
namespace {

/// Whether moving one of its bodies would make a joint act. A contact allows more distance; an angular motor, and a ball joint
/// with no ERP that is no softer than the world, tie velocities only, as the images of periodic grains. A bond is a soft ball
/// joint: a spring.
bool holds_place(dJointID joint, dWorldID world) {
  if (dJointIsEnabled(joint) == 0) return false;
  const dJointType type = dJointGetType(joint);
  if (type == dJointTypeBall)
    return dJointGetBallParam(joint, dParamERP) > 0 || dJointGetBallParam(joint, dParamCFM) > dWorldGetCFM(world);
  return type != dJointTypeContact && type != dJointTypeAMotor;
}

bool is_attached(dBodyID body) {
  if (body == nullptr) return false;
  for (int k = 0; k < dBodyGetNumJoints(body); ++k) {
    if (holds_place(dBodyGetJoint(body, k), dBodyGetWorld(body))) return true;
  }
  return false;
}

void set_velocities(dBodyID body, const Vector3& linear, const Vector3& angular) {
  dBodySetLinearVel(body, ode::to_real(linear.x()), ode::to_real(linear.y()), ode::to_real(linear.z()));
  dBodySetAngularVel(body, ode::to_real(angular.x()), ode::to_real(angular.y()), ode::to_real(angular.z()));
}

}  // namespace

std::size_t SpeculativeSetup::index_of(dBodyID body) {
  std::size_t& index = indices_.try_emplace(body, bodies_.size()).first->second;
  if (index >= bodies_.size() || bodies_[index].id != body) {
    index = bodies_.size();
    bodies_.push_back(MovingBody::of(body));
    bodies_.back().is_attached = is_attached(body);
  }
  return index;
}

bool SpeculativeSetup::lets_in(const PairMaterial& pair, dBodyID body1, dBodyID body2) {
  return pair.restitution > 0 && (bodies_[index_of(body1)].is_attached || bodies_[index_of(body2)].is_attached);
}

void SpeculativeSetup::set_up(const PairMaterial& pair, std::span<dContact> contacts, const Side& side1, const Side& side2) {
  if (contacts.empty()) return;
  const dContactGeom& geom = contacts.front().geom;
  Record record{&pair, 0, 0, contacts_.size(), 0, contacts.size()};
  if (is_elastic_) {
    record.body1 = index_of(side1.body), record.body2 = index_of(side2.body);
    sides_.emplace_back(geom.g1, side1), sides_.emplace_back(geom.g2, side2);
  }
  if (pair.is_speculative && pair.restitution > 0 && ode::looks_ahead(geom)) {
    record.count = contacts.size();
    const MovingBody& one = bodies_[record.body1];
    const MovingBody& other = bodies_[record.body2];
    record.may_bounce = one.inverse_mass + other.inverse_mass > 0 && !one.is_attached && !other.is_attached;
    contacts_.insert(contacts_.end(), contacts.begin(), contacts.end());
    set_up_alone(record, contacts);
  } else {
    for (dContact& contact : contacts) {
      if (contact.geom.depth < 0) let_close(contact, -double{contact.geom.depth}, step_);
    }
  }
  if (is_elastic_) records_.push_back(record);
}

/// Sets the contacts up for a pair that meets no other body in the step.
void SpeculativeSetup::set_up_alone(Record& record, std::span<dContact> contacts) {
  std::array<MovingBody, 2> bodies = {bodies_[record.body1], bodies_[record.body2]};
  alone_.assign(contacts.begin(), contacts.end());
  const Meeting alone{*record.pair, bodies[0], bodies[1], alone_, step_, record.may_bounce};
  for (auto impact = alone.next_impact(); impact; impact = alone.next_impact()) {
    alone.strike(*impact, pushes_);
    record.is_planned = true;
  }
  std::ranges::transform(alone_, contacts.begin(), [&](const MeetingContact& c) { return alone.row_of(c); });
}

void SpeculativeSetup::list_record(std::size_t index) {
  records_of_.resize(std::max(records_of_.size(), bodies_.size()));
  for (const std::size_t body : {records_[index].body1, records_[index].body2}) {
    if (bodies_[body].inverse_mass > 0) records_of_[body].push_back(index);
  }
  if (records_[index].is_planned) expect(index);
}

/// Lists the next impact of the record, if there is one.
void SpeculativeSetup::expect(std::size_t index) {
  const Record& record = records_[index];
  const auto impact = meeting(record).next_impact();
  if (!impact) return;
  events_.emplace_back(impact->time, index, bodies_[record.body1].impacts + bodies_[record.body2].impacts);
  std::ranges::push_heap(events_, std::greater<>());
}

void SpeculativeSetup::run_impacts() {
  while (!events_.empty()) {
    std::ranges::pop_heap(events_, std::greater<>());
    const auto [time, index, impacts] = events_.back();
    events_.pop_back();
    Record& record = records_[index];
    if (impacts != bodies_[record.body1].impacts + bodies_[record.body2].impacts) continue;
    meeting(record).strike(*meeting(record).next_impact(), pushes_);
    ++record.impacts;
    if (record.attached == 0) record.may_bounce = is_struck(bodies_[record.body1].inverse_mass > 0 ? record.body1 : record.body2);
    for (const std::size_t body : {record.body1, record.body2}) {
      std::ranges::for_each(records_of_[body], [&](std::size_t k) { expect(k); });
    }
  }
}

/// Replaces the contacts of a pair whose bodies have had other impacts than those that the contacts were set up for.
void SpeculativeSetup::exchange(std::size_t index) {
  const Record& record = records_[index];
  const auto is_left_alone = [&](const MovingBody& body) { return body.inverse_mass == 0 || body.impacts == record.impacts; };
  const Meeting now = meeting(record);
  if (is_left_alone(now.body1) && is_left_alone(now.body2)) return;
  const dBodyID one = now.body1.id, other = now.body2.id;
  rows_.clear();
  for (const MeetingContact& c : now.contacts) {
    const bool is_attached = record.attached > 0, was_hit = c.total > 0;
    if (is_attached) rows_.push_back(now.row_of(c));
    if (!is_attached && was_hit) exchanges_.push_back({nullptr, now.row_of(c), one, other});
    if (c.is_stop && (was_hit || !is_attached)) exchanges_.push_back({nullptr, now.stop_of(c), one, other});
  }
  if (record.attached == 0) return;
  listed_.clear();
  const bool is_free = now.body1.inverse_mass > 0;
  for (int k = dBodyGetNumJoints(is_free ? one : other); k-- > 0;) {  // ODE lists the last one first
    const dJointID joint = dBodyGetJoint(is_free ? one : other, k);
    const bool is_between = std::minmax(dJointGetBody(joint, 0), dJointGetBody(joint, 1)) == std::minmax(one, other);
    if (is_between && dJointGetType(joint) == dJointTypeContact) listed_.push_back(joint);
  }
  std::size_t first = 0, all = 0;  // of these
  for (const std::size_t k : records_of_[is_free ? record.body1 : record.body2]) {
    const Record& same = records_[k];
    if (std::minmax(same.body1, same.body2) != std::minmax(record.body1, record.body2)) continue;
    if (k < index) first += same.attached;
    all += same.attached;
  }
  if (listed_.size() != all) is_known_ = false;
  for (std::size_t k = 0; is_known_ && k < rows_.size(); ++k) exchanges_.push_back({listed_[first + k], rows_[k], one, other});
}

/// Makes the joints of all exchanges. If a program has not attached as many contacts as were set up, it is unknown which is which.
/// Then it makes none.
void SpeculativeSetup::make_joints() {
  if (!std::exchange(is_known_, true)) exchanges_.clear();
  for (const Exchange& exchange : exchanges_) {
    const dBodyID body = exchange.body1 != nullptr ? exchange.body1 : exchange.body2;
    const dJointID joint = dJointCreateContact(dBodyGetWorld(body), joints_.get(), &exchange.contact);
    dJointAttach(joint, exchange.body1, exchange.body2);
    if (exchange.old == nullptr) continue;
    dJointDisable(exchange.old);
    dJointSetFeedback(joint, dJointGetFeedback(exchange.old));
  }
  exchanges_.clear();
}

void SpeculativeSetup::move_bodies() const {
  for (const MovingBody& body : bodies_) {
    if (body.displacement.isZero(0)) continue;
    const Vector3 place = body.centre + body.displacement;
    const Vector3 velocity = ode::to_vector(dBodyGetLinearVel(body.id)) + body.gain;
    set_velocities(body.id, velocity, ode::to_vector(dBodyGetAngularVel(body.id)));
    dBodySetPosition(body.id, ode::to_real(place.x()), ode::to_real(place.y()), ode::to_real(place.z()));
  }
}

Side SpeculativeSetup::side_of(dGeomID geom) const {
  const auto known = std::ranges::lower_bound(sides_, geom, {}, &Met::first);
  return known != sides_.end() && known->first == geom ? known->second : Side{-1, dGeomGetBody(geom)};
}

/// Adds a record of contacts with a wall, a geom without a body or of a kinematic one.
void SpeculativeSetup::add_wall(void* data, dGeomID geom1, dGeomID geom2) {
  if (dGeomIsSpace(geom1) != 0 || dGeomIsSpace(geom2) != 0) return dSpaceCollide2(geom1, geom2, data, add_wall);
  const Search& search = *static_cast<const Search*>(data);
  SpeculativeSetup& setup = *search.setup;
  const dBodyID body = setup.bodies_[search.body].id;
  if (dGeomGetBody(geom1) != body) std::swap(geom1, geom2);
  const Side side = setup.side_of(geom2);
  const dBodyID wall = side.body;
  if ((wall != nullptr && dBodyIsKinematic(wall) == 0) || dAreConnectedExcluding(body, wall, dJointTypeContact) != 0) return;
  const PairMaterial& pair = setup.pairs_.of(setup.side_of(geom1).material, side.material);
  if (!pair.is_speculative) return;
  std::array<dContact, 8> contacts{};
  const int count = dCollide(geom1, geom2, static_cast<int>(contacts.size()), &contacts[0].geom, sizeof(dContact));
  const auto touches = [](const dContact& contact) { return !(contact.geom.depth < 0); };
  const auto end = std::remove_if(contacts.begin(), contacts.begin() + count, touches);
  if (end == contacts.begin()) return;
  const std::size_t other = setup.index_of(wall);
  const auto found = static_cast<std::size_t>(end - contacts.begin());
  setup.records_.push_back({&pair, search.body, other, setup.contacts_.size(), found, 0, search.bounces, search.bounces});
  setup.contacts_.insert(setup.contacts_.end(), contacts.begin(), end);
  setup.list_record(setup.records_.size() - 1);
}

/// Whether another free body has struck the body. Otherwise it bounces once a step at a wall without a contact: between two walls
/// there would be no end of impacts.
bool SpeculativeSetup::is_struck(std::size_t index) {
  return std::ranges::any_of(records_of_[index],
                             [&](std::size_t k) { return records_[k].impacts > 0 && !meeting(records_[k]).is_at_wall(); });
}

/// Finds walls on the way of a body after its impacts, and other places of known walls. A program has no contacts there: its are of
/// the motion before. Without this, of 480 heaps that a heavy body hits 29 lose a body through a thin floor; with it 1.
void SpeculativeSetup::find_walls(std::size_t index) {
  const MovingBody body = bodies_[index];
  const Vector3 velocity = ode::to_vector(dBodyGetLinearVel(body.id)), spin = ode::to_vector(dBodyGetAngularVel(body.id));
  set_velocities(body.id, body.velocity, body.angular_velocity);
  for (dGeomID geom = dBodyGetFirstGeom(body.id); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
    const ode::Body* const ours = ode::find_body(geom);
    if (ours == nullptr || body.velocity.norm() * step_ <= kShallow * ours->size()) continue;
    ode::set_moved(geom);  // the bounding box covers the motion
    dGeomID all = geom;
    while (dGeomGetSpace(all) != nullptr) all = reinterpret_cast<dGeomID>(dGeomGetSpace(all));
    Search search{this, index, is_struck(index)};
    if (all != geom) dSpaceCollide2(geom, all, &search, add_wall);
  }
  set_velocities(body.id, velocity, spin);
}

/// Lists the impact of the middle of a body at a wall that its contacts do not keep it from. Returns whether there is one.
bool SpeculativeSetup::bounce_middle(std::size_t index) {
  if (bodies_[index].impacts == 0 || (bodies_[index].is_thrown_back && !is_struck(index))) return false;
  for (const std::size_t k : records_of_[index]) {
    const Record wall = records_[k];
    const auto middle = meeting(wall).middle();
    if (!middle) continue;
    records_.push_back({wall.pair, wall.body1, wall.body2, contacts_.size(), 1, 0, true, true});
    contacts_.push_back(*middle);
    bodies_[index].is_thrown_back = true;
    list_record(records_.size() - 1);
    return true;
  }
  return false;
}

/// Stops a body after its impacts at all walls together, those that the program has listed and those that were found. Returns
/// whether this has changed its velocity.
bool SpeculativeSetup::stop_at_walls(std::size_t index) {
  MovingBody& body = bodies_[index];
  if (body.impacts == 0 || body.impacts >= 2 * kMostImpacts) return false;
  pushes_.clear();
  for (const std::size_t k : records_of_[index]) {
    if (const Meeting at = meeting(records_[k]); at.is_at_wall()) at.add_stops(pushes_);
  }
  const Vector3 velocity = body.velocity + solve_impulses(pushes_).head<3>();
  if (velocity.isApprox(body.velocity)) return false;
  for (const Push& push : pushes_) push.at->is_stop = true;
  body.velocity = velocity;
  ++body.impacts;
  return true;
}

void SpeculativeSetup::resolve() {
  dJointGroupEmpty(joints_.get());
  if (std::ranges::any_of(records_, &Record::is_planned)) {
    std::ranges::sort(sides_, {}, &Met::first);
    for (auto& records : records_of_) records.clear();
    for (std::size_t k = 0; k < records_.size(); ++k) list_record(k);
    for (bool is_changed = true; is_changed;) {
      run_impacts();
      is_changed = false;
      for (std::size_t k = 0; k < bodies_.size(); ++k) {
        const bool is_new = std::exchange(bodies_[k].impacts_searched, bodies_[k].impacts) < bodies_[k].impacts;
        if (is_new) find_walls(k);
        is_changed |= is_new;
      }
      for (std::size_t k = 0; !is_changed && k < bodies_.size(); ++k) is_changed = bounce_middle(k);
      for (std::size_t k = 0; !is_changed && k < bodies_.size(); ++k) is_changed = stop_at_walls(k);
    }
    for (std::size_t k = 0; k < records_.size(); ++k) exchange(k);
    make_joints();
    move_bodies();
  }
  if (indices_.size() > 2 * bodies_.size()) {
    std::erase_if(indices_,
                  [&](const auto& known) { return known.second >= bodies_.size() || bodies_[known.second].id != known.first; });
  }
  records_.clear();
  contacts_.clear();
  bodies_.clear();
  sides_.clear();
}

void SpeculativeSetup::remove(dBodyID body) {
  std::erase_if(records_,
                [&](const Record& record) { return bodies_[record.body1].id == body || bodies_[record.body2].id == body; });
}

}  // namespace supernormal::effects
