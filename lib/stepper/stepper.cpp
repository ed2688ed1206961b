#include "stepper/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <unordered_set>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "ode/support/require.hpp"
#include "supernormal/supernormal.h"

namespace supernormal::stepper {
namespace {

struct Claims {
  std::mutex mutex;
  std::unordered_set<dWorldID> worlds;  // those that have a stepper
};

Claims& claims() {
  static Claims all;
  return all;
}

dWorldID claimed(dWorldID world) {
  const std::scoped_lock lock(claims().mutex);
  if (claims().worlds.insert(world).second) return world;
  throw std::invalid_argument("world has a stepper already, which moves all its bodies: destroy that one first");
}

// Relative to the sag: the overlap that stays between geoms whose contacts are found only
// once they overlap. With less a corner that carries little leaves, falls until the next step finds it again, and stacks rock
// (README).
constexpr double kLateLayer = 4;

// Relative to the sag of a cube as thick as the thinner body: the most that stays. Five plates 1 m wide and 3 mm thick otherwise
// sink into one another by 0.7 of their thickness.
constexpr double kMostLayer = 10;

bool looks_ahead(dGeomID geom) {
  const ode::Body* const body = ode::find_body(geom);
  return body != nullptr && body->look_ahead() > 0;
}

bool is_late(const dContactGeom& contact) {
  return contact.g1 != nullptr && contact.g2 != nullptr && !looks_ahead(contact.g1) && !looks_ahead(contact.g2);
}

}  // namespace

void Stepper::Release::operator()(dWorldID world) const {
  const std::scoped_lock lock(claims().mutex);
  claims().worlds.erase(world);
}

Stepper::Stepper(dWorldID world) : world_(claimed(world)), contact_joints_(dJointGroupCreate(0)) {}

double Stepper::step(double time) {
  ode::require_positive("step", time, "s");
  const bool is_rest = left_ > 0 && std::abs(time - left_) <= 1e-6 * whole_;
  read_bodies(is_rest);
  set_up_contacts(time);
  if (!is_rest) whole_ = time;
  const int count = sub_steps_.choose(time, whole_);
  const double sub_step_time = time / count;
  soften(sub_step_time);
  moving_.choose(system_, time);
  centre();
  memory_.recall(system_, sub_step_time);
  for (Joint* const joint : system_.joints) joint->begin(system_, sub_step_time);
  moving_.follow(system_);  // a contact ahead has the normal of the place where the bodies will meet
  SweepSettings settings{
      .time = sub_step_time, .fastest_out = dWorldGetContactMaxCorrectingVel(world_.get()), .softness = softness_};
  double done = 0;
  int made = 0;
  do {
    settings.is_last = made + 1 == count;
    sub_step(made++, settings);
    done = made < count ? made * sub_step_time : time;
  } while (made < count && std::ranges::none_of(system_.bodies, [&](const Body& body) {
             return body.is_touched && body.has_left_path(done, time - done);
           }));
  left_ = time - done;
  if (!system_.contacts.empty() || !system_.joints.empty()) sub_steps_.learn(system_, done);  // what sleeps keeps its stiffness
  // In a far shorter step than the last an impulse is no force that lasts: times the next step it would throw the bodies.
  const double part = sub_step_time / sub_steps_.spring();
  memory_.keep(system_, sub_step_time, part);
  for (Joint* const joint : system_.joints) joint->keep(sub_step_time, part, done);
  keep_forces(done);
  step_others(time, done);
  for (Body& body : system_.bodies) {
    if (body.is_awake && !body.is_held) body.write(done / whole_);
  }
  let_sleep(done);
  given_.clear();
  return done;
}

// Bodies that touch one another are centred together, or a contact would push against half of a weight; so are bodies that a joint
// ties.
void Stepper::centre() {
  for (const Joint* const joint : system_.joints) {
    for (Body* const tied : {&body(joint->body1), &body(joint->body2)}) tied->is_followed = tied->is_dynamic();
  }
  spread(&Body::is_borne, &Body::is_free, Along::Joints);
  spread(&Body::is_centred, &Body::is_free);
  for (Body& body : system_.bodies) body.is_centred = body.is_dynamic() && (body.is_centred || !body.is_borne);
  for (Contact& contact : system_.contacts) {
    contact.part_before = std::min(system_.body1(contact).part_before(), system_.body2(contact).part_before());
  }
}

void Stepper::sub_step(int number, SweepSettings settings) {
  const double time = settings.time;
  settings.is_backward = number % 2 != 0;
  settings.elapsed = number * time;
  for (Body& body : system_.bodies) body.apply_forces(time * body.part_before());
  bounce(system_, time);
  for (Contact& contact : system_.contacts) system_.push_before(contact);
  for (Joint* const joint : system_.joints) system_.push_before(*joint);
  sweep(system_, settings);
  moving_.begin_turn(system_);
  for (Joint* const joint : system_.joints) joint->begin_turn(system_, time);
  for (Body& body : system_.bodies) body.advance(time);
  moving_.follow(system_);
  moving_.end_turn(system_);
  for (Joint* const joint : system_.joints) joint->end_turn(system_);
  for (Body& body : system_.bodies) body.apply_forces(time * (1 - body.part_before()));
  for (Contact& contact : system_.contacts) system_.push_after(contact);
  for (Joint* const joint : system_.joints) system_.push_after(*joint);
  settings.is_biased = false;
  settings.is_backward = !settings.is_backward;
  settings.elapsed += time;
  sweep(system_, settings);
  for (Contact& contact : system_.contacts) {
    for (Row& row : contact.rows) row.total += row.impulse;
  }
  for (Joint* const joint : system_.joints) joint->count_forces();
}

void Stepper::read_bodies(bool is_rest) {
  dVector3 gravity;
  dWorldGetGravity(world_.get(), gravity);
  for (Body& body : system_.bodies) {
    if (body.id == nullptr) continue;
    body.read(ode::to_vector(gravity), is_rest);
  }
  joints_.read(system_, indices_);
  spread(&Body::is_awake, &Body::stirs);
  spread(&Body::is_held, &Body::is_free);
  for (Body& body : system_.bodies) {
    if (!body.is_awake || body.is_of_quickstep()) body.hold_still();
  }
  std::erase_if(system_.joints,
                [&](const Joint* joint) { return !body(joint->body1).is_dynamic() && !body(joint->body2).is_dynamic(); });
}

// A kinematic body takes a property from what it touches, and passes it on only if it is a source.
void Stepper::spread(bool Body::*property, bool Body::*source, Along along) {
  bool has_spread = true;
  const auto visit = [&](int first, int second) {
    if (first <= 0 || second <= 0) return;
    Body& one = body(first);
    Body& two = body(second);
    const Body& from = one.*property ? one : two;
    if (one.*property == two.*property || !(from.*source)) return;
    one.*property = two.*property = has_spread = true;
  };
  while (has_spread) {
    has_spread = false;
    for (const Joint* const joint : system_.joints) visit(joint->body1, joint->body2);
    if (along == Along::Joints) continue;
    for (const Given& given : given_) visit(given.body1, given.body2);
  }
}

// Bodies that were not added are quickstep's, and what a joint ties that the stepper does not solve.
void Stepper::step_others(double planned, double time) {
  for (Given& given : given_) {
    if (!is_of_quickstep(given)) continue;
    snContactLookAhead(&given.contact, ode::to_real(planned));
    const dJointID joint = dJointCreateContact(world_.get(), contact_joints_.get(), &given.contact);
    dJointSetFeedback(joint, &given.feedback);
    dJointAttach(joint, body(given.body1).id, body(given.body2).id);
  }
  stopped_.clear();
  for (const Body& body : system_.bodies) {
    if (body.id == nullptr || dBodyIsEnabled(body.id) == 0) continue;
    if (body.is_held) {
      body.restore_forces();
      continue;
    }
    dBodyDisable(body.id);
    stopped_.push_back(body.id);
  }
  const auto ours = [&](const Joint& joint) {
    return !body(joint.body1).is_of_quickstep() && !body(joint.body2).is_of_quickstep();
  };
  joints_.enable(ours, false);  // quickstep would wake bodies along them
  dWorldQuickStep(world_.get(), ode::to_real(time));
  joints_.enable(ours, true);
  for (const dBodyID body : stopped_) dBodyEnable(body);
  for (std::size_t i = 0; i < given_.size(); ++i) {
    if (!is_of_quickstep(given_[i])) continue;
    const Vector3 force = ode::to_vector(given_[i].feedback.f1);  // on body 2, if body 1 is the world
    forces_[i] = given_[i].body1 == 0 ? Vector3(-force) : force;
  }
  dJointGroupEmpty(contact_joints_.get());
}

bool Stepper::is_of_quickstep(const Given& given) const {
  return given.body1 >= 0 && given.body2 >= 0 && (body(given.body1).is_of_quickstep() || body(given.body2).is_of_quickstep());
}

// Bodies that touch one another sleep together.
void Stepper::let_sleep(double time) {
  for (Body& body : system_.bodies) {
    if (body.id != nullptr && !body.is_held) body.watch(time);
  }
  spread(&Body::is_restless, &Body::stirs);
  for (const Body& body : system_.bodies) {
    if (!body.is_dynamic() || !(body.is_touched || body.is_followed) || body.is_restless) continue;
    dBodySetLinearVel(body.id, 0, 0, 0);
    dBodySetAngularVel(body.id, 0, 0, 0);
    dBodyDisable(body.id);
  }
}

void Stepper::set_up_contacts(double time) {
  system_.contacts.clear();
  system_.pairs.clear();
  system_.rolling.clear();
  system_.has_bounces = false;
  for (const Given& given : given_) {
    if (given.body1 < 0 || given.body2 < 0) continue;
    if (!body(given.body1).is_dynamic() && !body(given.body2).is_dynamic()) {
      memory_.leave(given.contact.geom.g1, body(given.body1), given.contact.geom.g2, body(given.body2));
      continue;
    }
    const Given* const last = system_.contacts.empty() ? nullptr : system_.contacts.back().given;
    const bool is_same_pair = last != nullptr && last->contact.geom.g1 == given.contact.geom.g1 &&
                              last->contact.geom.g2 == given.contact.geom.g2 && last->body1 == given.body1 &&
                              last->body2 == given.body2;
    if (!is_same_pair) system_.pairs.push_back({static_cast<int>(system_.contacts.size()), 0});
    ++system_.pairs.back().count;
    system_.contacts.push_back(contact_of(system_, given, time));
  }
}

void Stepper::soften(double sub_step) {
  softness_ = softness_in(sub_step, sub_steps_.spring());
  for (Contact& contact : system_.contacts) {
    const Surface& surface = contact.surface();
    const Body &one = system_.body1(contact), &two = system_.body2(contact);
    contact.layer = dWorldGetContactSurfaceLayer(world_.get());
    if (one.is_dynamic() && two.is_dynamic() && is_late(contact.given->contact.geom)) {
      const double depth = std::min(kLateLayer * contact.size, kMostLayer * std::min(one.thickness, two.thickness));
      contact.layer = std::max(contact.layer, sub_steps_.accuracy.sag * depth);
    }
    contact.softness = &softness_;
    if (surface.erp < 0 && !(surface.cfm > 0)) continue;
    const double erp = surface.erp < 0 ? double{dWorldGetERP(world_.get())} : surface.erp;
    Softness& own = given_[index_of(contact)].softness;
    own = softness_of(erp, std::max(0.0, surface.cfm), contact.normal().mobility, whole_, sub_step);
    contact.softness = &own;
  }
}

void Stepper::keep_forces(double time) {
  forces_.assign(given_.size(), Vector3::Zero());
  for (const Contact& contact : system_.contacts) {
    Vector3& force = forces_[index_of(contact)];
    force = contact.impact / time * contact.normal().direction;
    for (const Row& row : contact.rows) force += row.total / time * row.direction;
  }
}

std::vector<double> Stepper::save(std::span<const dGeomID> geoms) const {
  if (left_ > 0) throw std::invalid_argument("the last step ended early: save after the rest of it");
  const SubSteps::State state = sub_steps_.state();
  std::vector<double> numbers(state.begin(), state.end());
  memory_.save(geoms, numbers);
  return numbers;
}

void Stepper::load(std::span<const dGeomID> geoms, std::span<const double> numbers) {
  SubSteps::State state;
  const bool is_valid = numbers.size() >= state.size() && std::ranges::none_of(numbers, [](double x) { return std::isnan(x); }) &&
                        memory_.load(geoms, numbers.subspan(state.size()));
  if (!is_valid)
    throw std::invalid_argument("these " + std::to_string(numbers.size()) + " numbers are none of snStepperSave for these geoms");
  std::ranges::copy(numbers.first(state.size()), state.begin());
  sub_steps_.set(state);
  left_ = 0;
}

int Stepper::index_of(const char* name, dBodyID body) const {
  if (body == nullptr) return 0;
  const auto found = indices_.find(body);
  if (found == indices_.end()) {
    throw std::invalid_argument(std::string(name) + " is not a body of the stepper: add it by snStepperAddBody");
  }
  return found->second;
}

void Stepper::add_body(dBodyID body) {
  if (dBodyGetWorld(body) != world_.get()) throw std::invalid_argument("body is of another world than the stepper");
  if (indices_.contains(body)) throw std::invalid_argument("body is a body of the stepper already: it must be added once");
  system_.bodies.emplace_back().id = body;
  indices_[body] = static_cast<int>(system_.bodies.size()) - 1;
}

// The last body takes the place of the removed one.
void Stepper::remove_body(dBodyID body) {
  const int removed = index_of("body", body);
  const int last = static_cast<int>(system_.bodies.size()) - 1;
  for (Given& given : given_) {
    for (int* const index : {&given.body1, &given.body2}) *index = *index == removed ? -1 : *index == last ? removed : *index;
  }
  indices_[system_.bodies.back().id] = removed;
  system_.bodies[static_cast<std::size_t>(removed)] = system_.bodies.back();
  system_.bodies.pop_back();
  indices_.erase(body);
  memory_.forget(body);
  joints_.forget(body);
}

void Stepper::add_contact(const dContact& contact, dBodyID body1, dBodyID body2) {
  if (body1 == body2) throw std::invalid_argument("body1 = body2, but a contact must have two bodies, or one and NULL");
  given_.push_back({contact, surface_of(contact), index_of("body1", body1), index_of("body2", body2), {}, {}});
  if (given_.back().body1 == 0) given_.back().surface.motion[1] *= -1;  // as in ODE, which then reverses the normal, but not fdir1
}

const Vector3& Stepper::contact_force(int contact) const {
  const int count = static_cast<int>(forces_.size());
  if (contact < 0 || contact >= count) {
    throw std::invalid_argument("contact = " + std::to_string(contact) + " is not one of the " + std::to_string(count) +
                                " contacts of the last step");
  }
  return forces_[static_cast<std::size_t>(contact)];
}

}  // namespace supernormal::stepper
