// Two bodies of the kernel of samples/lammps, and their motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "kernel/pair_contact.hpp"
#include "kernel/particle_shape.hpp"

namespace granular::test {

constexpr double kDensity = 2500;  // kg/m^3

/// A free body with its mass and momentum.
class Particle {
 public:
  Particle(const Vector3& half_axes, double delta, double epsilon)
      : shape(std::make_shared<ParticleShape>(half_axes, delta, epsilon)), mass(kDensity * shape->volume) {
    place(Vector3::Zero(), Eigen::Quaterniond::Identity());
  }

  void place(const Vector3& position, const Eigen::Quaterniond& rotation) {
    attitude = rotation.normalized();
    body.pose.position = position;
    update();
  }
  void set_velocity(const Vector3& linear, const Vector3& angular) {
    body.velocity = linear;
    momentum = inertia_tensor() * angular;
    update();
  }
  void kick(const Vector3& force, const Vector3& torque, double step) {
    body.velocity += step / mass * force;
    momentum += step * torque;
    update();
  }
  void drift(double step) {
    body.pose.position += step * body.velocity;
    attitude = rotate_freely(attitude, momentum, mass * shape->unit_inertia, step);
    update();
  }
  double kinetic_energy() const { return 0.5 * mass * body.velocity.squaredNorm() + 0.5 * momentum.dot(body.angular_velocity); }

  std::shared_ptr<const ParticleShape> shape;
  double mass;  ///< kg
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  Vector3 momentum = Vector3::Zero();  ///< kg m^2/s; the angular momentum
  Body body;

 private:
  Matrix3 inertia_tensor() const {
    return body.pose.rotation * (mass * shape->unit_inertia).asDiagonal() * body.pose.rotation.transpose();
  }
  void update() {
    body.shape = &shape->body;
    body.width = shape->width;
    body.faces = shape->faces;
    body.sides = shape->sides;
    body.bulge = shape->bulge;
    body.pose.rotation = attitude.toRotationMatrix();
    body.inverse_mass = 1 / mass;
    body.inverse_inertia =
        body.pose.rotation * (mass * shape->unit_inertia).cwiseInverse().asDiagonal() * body.pose.rotation.transpose();
    body.angular_velocity = body.inverse_inertia * momentum;
  }
};

/// The slopes of an energy on both sides of a place. They differ where a point with adhesion begins to touch.
class Slopes {
 public:
  Slopes(double before, double here, double after, double step) : low_((here - before) / step), high_((after - here) / step) {
    if (low_ > high_) std::swap(low_, high_);
  }
  /// How far a slope is outside of what is between them.
  double miss(double slope) const { return std::max({0.0, low_ - slope, slope - high_}); }

 private:
  double low_, high_;
};

/// Two bodies and the history of their contact.
struct TwoBodies {
  Particle first, second;
  ContactMaterial material;
  ContactHistory history{};
  /// Close: a difference of energies shows the error of the gap, and the direction of the force the square root of it.
  supernormal::Settings settings{.tolerance = 1e-14};

  PairContact find(double step) { return find_pair_contact(first.body, second.body, material, settings, step, history); }

  /// How the energy of the contact changes as the second body moves along an axis (J/m) and rotates about it (J/rad).
  struct EnergySlopes {
    Slopes along, about;
  };
  /// Differences over `shift` (m) and `angle` (rad) either way.
  EnergySlopes energy_slopes(int axis, double shift, double angle) {
    const Vector3 position = second.body.pose.position, e = Vector3::Unit(axis);
    const Eigen::Quaterniond attitude = second.attitude;
    const auto energy_at = [&](double moved, double turned) {
      second.place(position + moved * e, Eigen::Quaterniond(Eigen::AngleAxisd(turned, e)) * attitude);
      return find(0).force.energy;
    };
    const double here = energy_at(0, 0);
    const EnergySlopes slopes{Slopes(energy_at(-shift, 0), here, energy_at(shift, 0), shift),
                              Slopes(energy_at(0, -angle), here, energy_at(0, angle), angle)};
    second.place(position, attitude);
    return slopes;
  }

  /// A step of velocity Verlet as in LAMMPS. `last` is the contact before and after it.
  void advance(double step, PairContact& last) {
    const auto kick = [&] {
      if (last.state != PairState::Touching) return;
      first.kick(last.force.force, last.torque1(), 0.5 * step);
      second.kick(-last.force.force, last.torque2(), 0.5 * step);
    };
    kick();
    first.drift(step);
    second.drift(step);
    last = find(step);
    kick();
  }
};

/// Two balls of a radius (m) that are about to touch along x and approach each other with the speed (m/s).
inline TwoBodies balls(double radius, double speed, const ContactMaterial& material) {
  const Vector3 axes = Vector3::Constant(radius);
  TwoBodies pair{{axes, 2, 2}, {axes, 2, 2}, prepared(material)};
  pair.first.place({-radius, 0, 0}, Eigen::Quaterniond::Identity());
  pair.second.place({radius, 0, 0}, Eigen::Quaterniond::Identity());
  pair.first.set_velocity({0.5 * speed, 0, 0}, Vector3::Zero());
  pair.second.set_velocity({-0.5 * speed, 0, 0}, Vector3::Zero());
  return pair;
}

/// The result of an impact.
struct Impact {
  double time = 0;     ///< s
  double overlap = 0;  ///< m; the largest
};

/// Runs until the bodies separate.
inline Impact collide(TwoBodies& pair, double step) {
  Impact impact;
  PairContact last;
  bool touched = false;
  for (int i = 0; i < 1000000; ++i) {
    pair.advance(step, last);
    if (last.state == PairState::Touching) {
      touched = true;
      impact.time += step;
      impact.overlap = std::max(impact.overlap, last.contact.depth);
    } else if (touched) {
      break;
    }
  }
  return impact;
}

}  // namespace granular::test
