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
#include <iterator>
#include <queue>
#include <tuple>
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

// Cosine; contacts with normals nearer than this are of one side of a surface, and those of two walls are farther apart.
constexpr double kSameSide = 0.9;

void set_velocities(dBodyID body, const Vector3& linear, const Vector3& angular) {
  dBodySetLinearVel(body, ode::to_real(linear.x()), ode::to_real(linear.y()), ode::to_real(linear.z()));
  dBodySetAngularVel(body, ode::to_real(angular.x()), ode::to_real(angular.y()), ode::to_real(angular.z()));
}

}  // namespace

std::size_t SpeculativeSetup::index_of(dBodyID body) {
  const auto [entry, is_new] = indices_.try_emplace(body, bodies_.size());
  if (is_new) {
    bodies_.push_back(MovingBody::of(body));
    bodies_.back().is_attached = is_attached(body);
  }
  return entry->second;
}

bool SpeculativeSetup::lets_in(const PairMaterial& pair, dBodyID body1, dBodyID body2) {
  return pair.restitution > 0 && (bodies_[index_of(body1)].is_attached || bodies_[index_of(body2)].is_attached);
}

void SpeculativeSetup::set_up(const PairMaterial& pair, std::span<dContact> contacts, dBodyID body1, dBodyID body2) {
  if (contacts.empty()) return;
  const dContactGeom& geom = contacts.front().geom;
  Record record{&pair, 0, 0, contacts_.size(), 0, contacts.size(), geom.g1, geom.g2};
  if (is_elastic_) record.body1 = index_of(body1), record.body2 = index_of(body2);
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
    alone.strike(*impact);
    record.is_planned = true;
  }
  std::ranges::transform(alone_, contacts.begin(), [&](const MeetingContact& c) { return alone.row_of(c); });
}

void SpeculativeSetup::list_records() {
  records_of_.assign(bodies_.size(), {});
  for (std::size_t k = 0; k < records_.size(); ++k) {
    for (const std::size_t body : {records_[k].body1, records_[k].body2}) {
      if (bodies_[body].inverse_mass > 0) records_of_[body].push_back(k);
    }
  }
}

void SpeculativeSetup::run_impacts() {
  const auto impacts_of = [&](const Record& record) { return bodies_[record.body1].impacts + bodies_[record.body2].impacts; };
  using Event = std::tuple<double, std::size_t, int>;  // time, record, and the impacts that its bodies had
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events;
  const auto expect = [&](std::size_t k) {
    if (const auto impact = meeting(records_[k]).next_impact()) events.emplace(impact->time, k, impacts_of(records_[k]));
  };
  for (std::size_t k = 0; k < records_.size(); ++k) {
    if (records_[k].is_planned) expect(k);
  }
  while (!events.empty()) {
    const auto [time, k, impacts] = events.top();
    events.pop();
    Record& record = records_[k];
    if (impacts != impacts_of(record)) continue;
    meeting(record).strike(*meeting(record).next_impact());
    ++record.impacts;
    for (const std::size_t body : {record.body1, record.body2}) std::ranges::for_each(records_of_[body], expect);
  }
}

/// Replaces the contacts of a pair whose bodies have had other impacts than those that the contacts were set up for.
void SpeculativeSetup::exchange(std::size_t index) {
  const Record& record = records_[index];
  const auto is_left_alone = [&](const MovingBody& body) { return body.inverse_mass == 0 || body.impacts == record.impacts; };
  const Meeting now = meeting(record);
  if (is_left_alone(now.body1) && is_left_alone(now.body2)) return;
  std::vector<dContact> rows;
  std::ranges::transform(now.contacts, std::back_inserter(rows), [&](const MeetingContact& c) { return now.row_of(c); });
  if (record.attached == 0) return joints_.add(rows, now.body1.id, now.body2.id);
  ContactExchange::Place place{now.body1.id, now.body2.id, 0, 0, record.count};
  for (const std::size_t k : records_of_[now.body1.inverse_mass > 0 ? record.body1 : record.body2]) {
    const Record& other = records_[k];
    if (std::minmax(other.body1, other.body2) != std::minmax(record.body1, record.body2)) continue;
    if (k < index) place.first += other.attached;
    place.all += other.attached;
  }
  joints_.replace(place, rows);
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

/// Adds a record of contacts with a wall, a geom without a body or of a kinematic one, that the program has none of.
void SpeculativeSetup::add_wall(void* data, dGeomID geom1, dGeomID geom2) {
  if (dGeomIsSpace(geom1) != 0 || dGeomIsSpace(geom2) != 0) return dSpaceCollide2(geom1, geom2, data, add_wall);
  const Search& search = *static_cast<const Search*>(data);
  SpeculativeSetup& setup = *search.setup;
  const dBodyID body = setup.bodies_[search.body].id;
  if (dGeomGetBody(geom1) != body) std::swap(geom1, geom2);
  const dBodyID wall = dGeomGetBody(geom2);
  if ((wall != nullptr && dBodyIsKinematic(wall) == 0) || dAreConnectedExcluding(body, wall, dJointTypeContact) != 0) return;
  std::array<dContact, 8> contacts{};
  const int count = dCollide(geom1, geom2, static_cast<int>(contacts.size()), &contacts[0].geom, sizeof(dContact));
  // The program may have contacts with another side of a surface.
  const auto is_known = [&](const dContact& contact) {
    return !(contact.geom.depth < 0) || std::ranges::any_of(setup.records_of_[search.body], [&](std::size_t k) {
      const Record& other = setup.records_[k];
      if (std::minmax(other.geom1, other.geom2) != std::minmax(geom1, geom2)) return false;
      const auto known = std::span(setup.contacts_).subspan(other.first, other.count);
      const Vector3 normal = (other.geom1 == geom1 ? 1 : -1) * ode::to_vector(contact.geom.normal);
      return known.empty() || std::ranges::any_of(known, [&](const auto& c) { return c.normal.dot(normal) > kSameSide; });
    });
  };
  const auto end = std::remove_if(contacts.begin(), contacts.begin() + count, is_known);
  if (end == contacts.begin()) return;
  const auto found = static_cast<std::size_t>(end - contacts.begin());
  const bool bounces = search.bounces;
  const std::size_t other = setup.index_of(wall);
  setup.records_of_.resize(setup.bodies_.size());
  setup.records_of_[search.body].push_back(setup.records_.size());
  setup.records_.push_back({search.pair, search.body, other, setup.contacts_.size(), found, 0, geom1, geom2, bounces, bounces});
  setup.contacts_.insert(setup.contacts_.end(), contacts.begin(), end);
}

/// Finds walls on the way of bodies after their impacts. A program has no contacts there: its are of the motion before. Without
/// this, of 480 heaps that a heavy body hits 29 lose a body through a thin floor; with it 2.
void SpeculativeSetup::find_walls() {
  const std::vector<Record> struck = records_;
  for (const Record& record : struck) {
    // Between two walls there would be no end of impacts.
    const bool bounces = bodies_[record.body1].inverse_mass > 0 && bodies_[record.body2].inverse_mass > 0;
    for (const std::size_t index : {record.body1, record.body2}) {
      const MovingBody body = bodies_[index];
      if (record.impacts == 0 || !(body.inverse_mass > 0)) continue;
      const Vector3 velocity = ode::to_vector(dBodyGetLinearVel(body.id)), spin = ode::to_vector(dBodyGetAngularVel(body.id));
      set_velocities(body.id, body.velocity, body.angular_velocity);
      for (dGeomID geom = dBodyGetFirstGeom(body.id); geom != nullptr; geom = dBodyGetNextGeom(geom)) {
        const ode::Body* const ours = ode::find_body(geom);
        if (ours == nullptr || body.velocity.norm() * step_ <= kShallow * ours->size()) continue;
        ode::set_moved(geom);  // the bounding box covers the motion
        dGeomID all = geom;
        while (dGeomGetSpace(all) != nullptr) all = reinterpret_cast<dGeomID>(dGeomGetSpace(all));
        Search search{this, index, record.pair, bounces};
        if (all != geom) dSpaceCollide2(geom, all, &search, add_wall);
      }
      set_velocities(body.id, velocity, spin);
    }
  }
}

void SpeculativeSetup::resolve() {
  joints_.clear();
  if (std::ranges::any_of(records_, &Record::is_planned)) {
    list_records();
    run_impacts();
    find_walls();
    run_impacts();
    for (const Record& record : records_) {
      if (record.attached == 0) meeting(record).stop_at_wall();
    }
    for (std::size_t k = 0; k < records_.size(); ++k) exchange(k);
    joints_.commit();
    move_bodies();
  }
  records_.clear();
  contacts_.clear();
  bodies_.clear();
  indices_.clear();
}

void SpeculativeSetup::remove(dBodyID body) {
  std::erase_if(records_,
                [&](const Record& record) { return bodies_[record.body1].id == body || bodies_[record.body2].id == body; });
}

}  // namespace supernormal::effects
