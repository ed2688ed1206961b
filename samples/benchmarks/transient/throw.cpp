#include "throw.hpp"

#include <supernormal/supernormal.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pairs.hpp"
#include "supernormal/proximity/clearance.hpp"
#include "supernormal/shapes/superellipsoid.hpp"

namespace transient {
namespace {

using accuracy_cost::BodyClass;
using supernormal::Pose;

constexpr double kDensity = 1000;        // kg/m^3
constexpr double kSpeed = 5;             // m/s; towards the middle, plus as much again in a random direction
constexpr double kSpin = 2;              // rad/s, about each axis, at most
constexpr double kGravity = 9.81;        // m/s^2
constexpr double kFriction = 0.5;        // Coulomb's
constexpr double kErrorReduction = 0.2;  // ODE's default; elastic bodies have none, because it would add energy
constexpr double kDisturbance = 1e-12;   // m
constexpr int kIterations = 40;          // of quickstep
constexpr int kMostTries = 1000;         // to place a body

/// m; the distance of bodies in the initial lattice. A body has half-axes of up to 1.5 m.
double spacing_of(BodyClass body_class) { return body_class == BodyClass::Needle ? 2 : 3.3; }

dGeomID create_geom(dSpaceID space, const supernormal::Shape& shape) {
  const Vector3 a = shape.half_extents();
  const auto* const body = dynamic_cast<const supernormal::Superellipsoid*>(&shape);
  const double delta = body == nullptr ? 2 : body->delta(), epsilon = body == nullptr ? 2 : body->epsilon();
  const dGeomID geom = snCreateSuperellipsoid(space, dReal(a.x()), dReal(a.y()), dReal(a.z()), dReal(delta), dReal(epsilon));
  if (geom == nullptr) throw std::runtime_error(snLastError());
  return geom;
}

Vector3 vector_of(const dReal* v) { return {double{v[0]}, double{v[1]}, double{v[2]}}; }

}  // namespace

Throw::Throw(const Setup& setup, bool is_disturbed) : setup_(setup) {
  dWorldSetQuickStepNumIterations(world_.id(), kIterations);
  dWorldSetERP(world_.id(), setup.has_friction ? kErrorReduction : 0);
  if (setup.has_friction) dWorldSetGravity(world_.id(), 0, 0, -kGravity);
  dRandSetSeed(1);
  place_bodies(is_disturbed);
}

Throw::~Throw() { dSpaceDestroy(walls_); }

void Throw::place_bodies(bool is_disturbed) {
  common::Random random(setup_.seed);
  const int side = static_cast<int>(std::lround(std::ceil(std::cbrt(setup_.bodies) - 1e-9)));
  const double spacing = spacing_of(setup_.body_class);
  const double half_width = 0.5 * side * spacing;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Vector3 inward = Vector3::Zero();
      inward[axis] = -sign;
      dCreatePlane(walls_, inward.x(), inward.y(), inward.z(), -half_width);
    }
  }
  std::vector<Pose> poses;
  for (int k = 0; k < setup_.bodies; ++k) {
    const int row = k / side, layer = row / side;
    const Vector3 cell(k % side, row % side, layer);
    shapes_.push_back(accuracy_cost::random_body(random, setup_.body_class));
    Pose pose;
    pose.position = (cell.array() + 0.5).matrix() * spacing - Vector3::Constant(half_width);
    const auto is_free = [&] {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {-1.0, 1.0}) {
          const Vector3 n = sign * Vector3::Unit(axis);
          const Vector3 reach = pose.rotation * shapes_.back()->point(pose.rotation.transpose() * n) + pose.position;
          if (reach.dot(n) >= half_width) return false;
        }
      }
      for (std::size_t other = 0; other < poses.size(); ++other) {
        if ((poses[other].position - pose.position).norm() > 2 * spacing) continue;
        if (!is_farther_than(*shapes_[other], poses[other], *shapes_.back(), pose, 0)) return false;
      }
      return true;
    };
    int tries = 0;
    do {
      if (++tries > kMostTries) throw std::runtime_error("a body finds no room in the lattice");
      pose.rotation = accuracy_cost::random_orientation(random);
    } while (!is_free());
    poses.push_back(pose);

    const dGeomID geom = create_geom(world_.space(), *shapes_.back());
    const dBodyID body = world_.add(geom, kDensity);
    numbers_.push_back(bodies_.size());
    dGeomSetData(geom, &numbers_.back());
    const Eigen::Quaterniond q(pose.rotation);
    const dQuaternion quaternion = {q.w(), q.x(), q.y(), q.z()};
    dBodySetQuaternion(body, quaternion);
    const double disturbance = is_disturbed && k == 0 ? kDisturbance : 0;
    dBodySetPosition(body, pose.position.x() + disturbance, pose.position.y(), pose.position.z());
    const double distance = pose.position.norm();
    const Vector3 towards = distance > 0 ? Vector3(-pose.position / distance) : Vector3::Zero();
    const Vector3 velocity = kSpeed * (towards + random.uniform() * accuracy_cost::random_normal(random));
    const Vector3 spin = kSpin * accuracy_cost::random_normal(random);
    dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(body, spin.x(), spin.y(), spin.z());
    bodies_.push_back(body);
  }
}

const std::vector<Neighbours>& Throw::neighbours() {
  neighbours_.clear();
  const auto number = [](dGeomID geom) { return *static_cast<std::size_t*>(dGeomGetData(geom)); };
  world_.collide([&](dGeomID geom1, dGeomID geom2) { neighbours_.push_back(std::minmax({number(geom1), number(geom2)})); });
  // In an order that does not depend on the broad phase.
  std::ranges::sort(neighbours_);
  return neighbours_;
}

void Throw::add_contact(dContact& contact, dBodyID body1, dBodyID body2) {
  contact.surface.mode = setup_.has_friction ? dContactApprox1 : dContactBounce;
  contact.surface.mu = setup_.has_friction ? kFriction : 0;
  contact.surface.bounce = 1;
  contact.surface.bounce_vel = 0;
  world_.join(contact, body1, body2);
}

void Throw::add_wall_contact(dGeomID geom1, dGeomID geom2) {
  dContact contact{};
  if (dCollide(geom1, geom2, 1, &contact.geom, sizeof contact) == 0) return;
  add_contact(contact, dGeomGetBody(geom1), dGeomGetBody(geom2));
}

void Throw::step(const std::vector<Touch>& touches) {
  for (std::size_t k = 0; k < touches.size(); ++k) {
    if (!touches[k].overlaps) continue;
    dContact contact{};
    for (int axis = 0; axis < 3; ++axis) {
      contact.geom.pos[axis] = dReal(touches[k].position[axis]);
      contact.geom.normal[axis] = -dReal(touches[k].normal[axis]);  // ODE's normal points into the first body
    }
    contact.geom.depth = dReal(touches[k].depth);
    add_contact(contact, bodies_[neighbours_[k].first], bodies_[neighbours_[k].second]);
  }
  world_.collide_with(walls_, [this](dGeomID geom1, dGeomID geom2) { add_wall_contact(geom1, geom2); });
  world_.step(setup_.step);
}

Pose Throw::pose(std::size_t body) const {
  const dReal* const r = dBodyGetRotation(bodies_[body]);
  Pose pose;
  for (int row = 0; row < 3; ++row) pose.rotation.row(row) = vector_of(r + 4 * row).transpose();
  pose.position = position(body);
  return pose;
}

Vector3 Throw::position(std::size_t body) const { return vector_of(dBodyGetPosition(bodies_[body])); }

}  // namespace transient
