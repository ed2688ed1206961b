// Bodies with faces and sides, in any orientation, and a floor.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "common/motion.hpp"
#include "kernel/face_contact.hpp"
#include "kernel/walls/wall.hpp"
#include "kernel/walls/wall_contacts.hpp"
#include "support/relative.hpp"
#include "two_bodies.hpp"

namespace granular::test {

inline const Vector3 kBrick(0.02, 0.015, 0.01);  // m

/// Draws in braces are in their order, which for the arguments of a call each compiler chooses.
struct Random {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vector3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  Eigen::Quaterniond attitude() {
    return Eigen::Quaterniond{(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)}.normalized();
  }
};

/// A rotation that brings an axis of the body to z.
inline Eigen::Quaterniond face_up(int axis) { return common::rotation_between(Vector3::Unit(axis), Vector3::UnitZ()); }

/// A small rotation about a horizontal axis after any rotation about z.
inline Eigen::Quaterniond tilted(double tilt, Random& random) {
  const double direction = random(0, 2 * std::numbers::pi);
  return Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vector3(std::cos(direction), std::sin(direction), 0))) *
         Eigen::Quaterniond(Eigen::AngleAxisd(random(0, 2 * std::numbers::pi), Vector3::UnitZ()));
}

/// A body whose axis z lies along x.
inline const Eigen::Quaterniond kLies(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitY()));

/// The height (m), down from `height` in steps, at which a body that place(height) puts there touches.
template <typename Place, typename Touches>
double touching_height(double height, double step, Place place, Touches touches) {
  place(height);
  while (!touches()) place(height -= step);
  return height;
}

/// Lowers the second body on the first one until they touch, and by up to 2e-4 m more. `world` rotates both.
inline void lower(TwoBodies& pair, const Eigen::Quaterniond& world, const Vector3& aside, Random& random) {
  const Eigen::Quaterniond attitude1 = pair.first.attitude, attitude2 = pair.second.attitude;
  pair.first.place(Vector3::Zero(), world * attitude1);
  const auto place = [&](double height) {
    pair.second.place(world * Vector3(aside + height * Vector3::UnitZ()), world * attitude2);
  };
  const double touching = touching_height(0.06, 1e-4, place, [&] { return pair.find(0).state == PairState::Touching; });
  place(touching - random(0, 2e-4));
}

struct Floor {
  std::shared_ptr<Wall> wall = std::make_shared<PlaneWall>(Vector3::Zero(), Vector3::UnitZ());
  Body body;
  WallHistory history;
  std::vector<WallContact> contacts;

  WallForce find(const Particle& particle, const ContactMaterial& material, double step) {
    return find_wall_force(*wall, body, *particle.shape, particle.body, material, step, history, contacts);
  }
  /// A step with gravity. `last` is the force before and after it.
  void advance(Particle& particle, const ContactMaterial& material, double step, double gravity, WallForce& last) {
    const Vector3 weight(0, 0, -particle.mass * gravity);
    particle.kick(last.force + weight, last.torque, 0.5 * step);
    particle.drift(step);
    last = find(particle, material, step);
    particle.kick(last.force + weight, last.torque, 0.5 * step);
  }
};

/// Compares the force of a floor on a body that sinks into it by 1e-4 m with the slopes of the energy. The body starts 0.05 m above
/// `aside` and falls down.
inline void check_slopes(Particle& body, Eigen::Quaterniond attitude, const ContactMaterial& material, Floor floor = {},
                         const Vector3& aside = Vector3::Zero()) {
  const double scale = material.stiffness * 1e-4;  // N
  const auto fall_to = [&](double height) { body.place(aside + height * Vector3::UnitZ(), attitude); };
  fall_to(touching_height(0.05, 5e-5, fall_to, [&] { return floor.find(body, material, 0).energy != 0; }) - 1e-4);
  const Vector3 place = body.body.pose.position;
  const WallForce force = floor.find(body, material, 0);
  const auto energy = [&](const Vector3& shift, const Eigen::Quaterniond& turn) {
    body.place(place + shift, turn * attitude);
    return floor.find(body, material, 0).energy;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved = [&](double way) { return energy(way * Vector3::Unit(axis), Eigen::Quaterniond::Identity()); };
    CHECK(Slopes(moved(-1e-9), force.energy, moved(1e-9), 1e-9).miss(-force.force[axis]) < 1e-4 * scale);
    const auto turn = [&](double angle) { return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3::Unit(axis))); };
    const auto turned = [&](double angle) { return energy(Vector3::Zero(), turn(angle)); };
    CHECK(Slopes(turned(-1e-7), force.energy, turned(1e-7), 1e-7).miss(-force.torque[axis]) < 1e-4 * scale * 0.02);
  }
}

inline ContactMaterial sticky(int i) { return prepared({.stiffness = 1e5, .adhesion = i % 2 == 0 ? 0 : 3.0}); }

/// Draws two bodies that touch, tilted by up to `tilt` (rad).
using Setup = TwoBodies (*)(Random& random, double tilt, const ContactMaterial& material);

/// Compares forces and torques of faces and sides with the slopes of the energy. `slack`: N, added to the force that differences
/// are compared with.
inline void check_pair_slopes(Setup setup, unsigned seed, double tilt, double slack) {
  Random random{std::mt19937(seed)};
  int meeting = 0, fading = 0;
  for (int i = 0; i < 400; ++i) {
    TwoBodies pair = setup(random, tilt, {.stiffness = 1e5, .adhesion = i % 2 == 0 ? 0 : 3.0});
    const PairContact contact = pair.find(0);
    const auto found = find_face_contact(pair.first.body, pair.second.body, contact.contact.normal);
    if (!found) continue;
    ++meeting;
    fading += found->share < 1 ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double scale = contact.force.normal + pair.material.adhesion + slack;
      const TwoBodies::EnergySlopes slopes = pair.energy_slopes(axis, 1e-9, 1e-7);
      CAPTURE(i);
      CAPTURE(found->share);
      CHECK(slopes.along.miss(contact.force.force[axis]) < 1e-4 * scale);
      CHECK(slopes.about.miss(-contact.torque2()[axis]) < 1e-4 * scale * 0.02);
    }
  }
  CHECK(meeting > 100);
  CHECK(fading > 20);
}

/// The exchanged pair has the same energy, to within `tolerance` of it, the opposite force, and as a whole no moment.
inline void check_exchange(Setup setup, unsigned seed, double tolerance) {
  Random random{std::mt19937(seed)};
  for (int i = 0; i < 100; ++i) {
    TwoBodies pair = setup(random, 0.05, {.stiffness = 1e5});
    TwoBodies other{pair.second, pair.first, pair.material};
    const PairContact there = pair.find(0), back = other.find(0);
    CHECK(back.force.energy == supernormal::test::relative(there.force.energy).epsilon(tolerance));
    CHECK((back.force.force + there.force.force).norm() < std::max(1e-6, 10 * tolerance) * there.force.force.norm());
    const Vector3 moment = there.torque1() + there.torque2() +
                           (pair.first.body.pose.position - pair.second.body.pose.position).cross(there.force.force);
    CHECK(moment.norm() <= 1e-14 * there.force.force.norm());
  }
}

/// Bodies that tumble keep their energy through an impact without damping.
inline void check_energy(Setup setup, unsigned seed) {
  Random random{std::mt19937(seed)};
  for (int i = 0; i < 10; ++i) {
    TwoBodies pair = setup(random, 0.03, {.stiffness = 1e5});
    pair.first.set_velocity(Vector3::Zero(), random.vector(1));
    PairContact last = pair.find(0);
    const auto energy = [&] { return pair.first.kinetic_energy() + pair.second.kinetic_energy() + last.force.energy; };
    const double start = energy();
    for (int step = 0; step < 20000; ++step) pair.advance(5e-7, last);
    CHECK(energy() == supernormal::test::relative(start).epsilon(1e-4));
  }
}

}  // namespace granular::test
