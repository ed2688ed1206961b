#include "stepper/moving_contacts.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "ode/geom/body.hpp"
#include "ode/geom/convert.hpp"
#include "supernormal/proximity/gap_function.hpp"
#include "supernormal/proximity/proximity.hpp"
#include "supernormal/proximity/solve.hpp"

namespace supernormal::stepper {
namespace {

// Relative to the size: what is farther apart hardly meets in the step.
constexpr double kNear = 0.01;

// rad, and relative to the size: bodies that move less in a step rest. Their contact stays.
constexpr double kRests = 1e-5;

// rad; flat bodies that turn less in a step have a contact that stays, up to the manifold of the next step.
constexpr double kRestsFlat = 0.002;

// rad; a manifold of which one point touches follows if the body turns more in a step, as the rim of a coin that spins.
constexpr double kSpins = 0.02;

// rad; a step of Newton's method that turns a normal by more is not right: it finds overlaps of many sizes (README).
constexpr double kLongTurn = 0.2;

// Relative to the size: contacts whose gaps differ by less touch together.
constexpr double kTogether = 1e-4;

bool is_round(const Shape* shape) { return shape == nullptr || shape->traits().is_round; }

Pose pose_of(const Body& body, const Pose& in_body) {
  return {body.centre() + body.rotation * in_body.position, body.rotation * in_body.rotation};
}

/// Moves a contact. The impulses across the normal turn with it.
void place_at(System& system, Contact& contact, const Vector3& place, const Vector3& normal, double gap) {
  set_rows(system, contact, place, normal, contact.rows[1].direction);
  contact.gap = gap;
}

struct Answer {
  Vector3 place, normal;  // world frame; the normal points into body 1
  double gap;
};

/// The common normal of round bodies, one step of Newton's method from `first`, the last one (body 1's frame). The gap is then
/// right to the fourth order of the change. False, if the step is too long for that.
bool step_to_normal(const Shape& shape1, const Pose& pose1, const Shape& shape2, const Pose& pose2, const Vector3& first,
                    Answer& answer) {
  GapFunction function(shape1, pose1, shape2, pose2);
  GapJet jet;
  function.evaluate(first, Order::Hessian, jet);
  const Matrix3 H2 = function.rotation() * jet.jet2.H * function.rotation().transpose();
  const Matrix3 curvature = jet.jet1.H + H2 + jet.s * Matrix3::Identity();
  const Vector3 slope = jet.d - jet.s * first;
  // Regular in three dimensions, with the same solution in the tangent plane.
  const Vector3 dn = (curvature + curvature.trace() * first * first.transpose()).inverse() * slope;
  if (!(dn.norm() < kLongTurn)) return false;
  const Vector3 point1 = jet.jet1.r + jet.jet1.H * dn;
  const Vector3 point2 = function.offset() + function.rotation() * jet.jet2.r - H2 * dn;
  answer.place = pose1.position + pose1.rotation * (0.5 * (point1 + point2));
  answer.normal = pose1.rotation * -(first + dn).normalized();
  answer.gap = jet.s + 0.5 * slope.dot(dn);
  return true;
}

/// m/s; along the rows.
Vector3 velocity_along(const System& system, const Contact& contact) {
  const Vector3 velocity = system.velocity(contact);
  return {velocity.dot(contact.rows[0].direction), velocity.dot(contact.rows[1].direction),
          velocity.dot(contact.rows[2].direction)};
}

}  // namespace

void MovingContacts::choose(System& system, double step) {
  list_.clear();
  for (const Pair& pair : system.pairs) choose_of(system, pair, step);
  system.centring.assign(list_.size(), Vector3::Zero());
}

void MovingContacts::choose_of(System& system, const Pair& pair, double step) {
  const std::span<Contact> contacts = system.contacts_of(pair);
  const Contact& contact = contacts.front();
  if (contact.gap >= kNear * contact.size || contact.gap < -kDeep * contact.size) return;
  const Body& one = system.body1(contact);
  const Body& two = system.body2(contact);
  const double turn = step * (one.angular_velocity - two.angular_velocity).norm();
  const double motion =
      step * (one.angular_velocity.norm() + two.angular_velocity.norm() + (one.velocity - two.velocity).norm() / contact.size);
  if (motion < kRests) return;
  Moving moving;
  if (!moving.read_sides(system, contact)) return;
  const bool has_plane = moving.side1.shape == nullptr || moving.side2.shape == nullptr;
  if (!(is_round(moving.side1.shape) && is_round(moving.side2.shape)) && turn < kRestsFlat) return;
  if (pair.count > 1) {
    const auto touching =
        std::ranges::count_if(contacts, [&](const Contact& other) { return other.gap < contact.gap + kTogether * contact.size; });
    if (!has_plane || turn < kSpins || touching > 1) return;
  }
  for (Contact& moved : contacts) {
    if (moved.gap >= kNear * moved.size) continue;
    moved.moving = static_cast<int>(list_.size());
    moving.contact = static_cast<int>(&moved - system.contacts.data());
    moving.is_fixed = &moved != &contact;
    moving.place1 = one.rotation.transpose() * moved.arm1;
    moving.place2 = two.rotation.transpose() * moved.arm2;
    list_.push_back(moving);
  }
  for (Body* const body : {&system.body1(contact), &system.body2(contact)})
    body->is_followed = body->is_centred = body->is_dynamic();
}

bool MovingContacts::Moving::read_sides(const System& system, const Contact& at) {
  const auto read = [&](dGeomID geom, const Body& body, Side& side) {
    if (geom == nullptr) return false;
    if (dGeomGetClass(geom) == dPlaneClass) {
      dVector4 plane;
      dGeomPlaneGetParams(geom, plane);
      plane_normal = body.rotation.transpose() * ode::to_vector(plane);
      plane_point = body.rotation.transpose() * (plane[3] * ode::to_vector(plane) - body.start);
      return true;
    }
    const ode::Body* const ours = ode::find_body(geom);
    if (ours == nullptr) return false;
    const Pose pose = ode::pose_of(geom);
    side.shape = &ours->shape();
    side.in_body = {body.rotation.transpose() * (pose.position - body.start), body.rotation.transpose() * pose.rotation};
    return true;
  };
  const dContactGeom& geometry = at.given->contact.geom;
  return read(geometry.g1, system.body1(at), side1) && read(geometry.g2, system.body2(at), side2) &&
         (side1.shape != nullptr || side2.shape != nullptr);
}

void MovingContacts::Moving::follow(System& system) const {
  Contact& at = system.contacts[std::size_t(contact)];
  const Body& one = system.body1(at);
  const Body& two = system.body2(at);
  if (is_fixed) {
    const Vector3 point1 = one.centre() + one.rotation * place1;
    const Vector3 point2 = two.centre() + two.rotation * place2;
    const Vector3 normal = at.normal().direction;
    const Vector3 place = at.body1 == 0 ? point2 : at.body2 == 0 ? point1 : Vector3(0.5 * (point1 + point2));
    place_at(system, at, place, normal, at.first_gap + normal.dot(point1 - point2));
    return;
  }
  if (side1.shape == nullptr || side2.shape == nullptr) {
    const bool is_first = side1.shape != nullptr;
    const Pose pose = is_first ? pose_of(one, side1.in_body) : pose_of(two, side2.in_body);
    const Shape& shape = is_first ? *side1.shape : *side2.shape;
    const Pose plane = pose_of(is_first ? two : one, {plane_point, Matrix3::Identity()});
    const Vector3 normal = plane.rotation * plane_normal;
    const Vector3 place = pose.position + pose.rotation * shape.point(pose.rotation.transpose() * -normal);
    if (!place.allFinite()) return;
    place_at(system, at, place, is_first ? normal : Vector3(-normal), normal.dot(place - plane.position));
    return;
  }
  const Pose pose1 = pose_of(one, side1.in_body);
  const Pose pose2 = pose_of(two, side2.in_body);
  const Vector3 first = (pose1.rotation.transpose() * -at.normal().direction).normalized();
  Answer answer;
  if (!(is_round(side1.shape) && is_round(side2.shape) &&
        step_to_normal(*side1.shape, pose1, *side2.shape, pose2, first, answer))) {
    const Proximity found = find_proximity(*side1.shape, pose1, *side2.shape, pose2, {}, &first);
    if (found.status == Status::InvalidInput) return;
    answer = {found.contact, -found.normal, found.gap};
  }
  place_at(system, at, answer.place, answer.normal, answer.gap);
}

void MovingContacts::follow(System& system) const {
  for (const Moving& moving : list_) moving.follow(system);
}

void MovingContacts::begin_turn(const System& system) {
  for (Moving& moving : list_) moving.before = velocity_along(system, system.contacts[std::size_t(moving.contact)]);
}

void MovingContacts::end_turn(System& system) const {
  for (const Moving& moving : list_) {
    const Contact& contact = system.contacts[std::size_t(moving.contact)];
    const Vector3 taken = velocity_along(system, contact) - moving.before;
    Vector3& centring = system.centring[std::size_t(contact.moving)];
    centring.setZero();
    for (int k = 0; k < 3; ++k) centring -= 0.5 * taken[k] * contact.rows[std::size_t(k)].direction;
  }
}

}  // namespace supernormal::stepper
