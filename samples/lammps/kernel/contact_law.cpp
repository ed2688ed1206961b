#include "kernel/contact_law.hpp"

#include <algorithm>
#include <cmath>

#include "supernormal/contact/hertz.hpp"

namespace granular {

SliderForce slide(const Vector3& spring, const Vector3& rate, double stiffness, double damping, double limit) {
  const Vector3 force = -(stiffness * spring + damping * rate);
  const double size = force.norm();
  if (size <= limit) return {force, spring, false};
  const Vector3 cut = (limit / size) * force;
  return {cut, -(cut + damping * rate) / stiffness, true};
}

NormalForce hooke_force(const ContactMaterial& material, double depth) {
  const double force = material.stiffness * depth;
  return {force, material.stiffness, 0.5 * force * depth};
}

NormalForce hertz_force(const ContactMaterial& material, double depth, const supernormal::ContactCurvature& curvature,
                        double width) {
  const double punch = 2 * material.stiffness * width;  // N/m
  // An ellipse longer than a thousand times its width counts as a line contact.
  const double smaller = std::max(curvature.smaller, 1e-6 * curvature.larger);
  if (!(smaller > 0)) return {punch * depth, punch, 0.5 * punch * depth * depth};
  const double correction = supernormal::hertz_correction(curvature.larger / smaller);
  const double factor = 4.0 / 3 * material.stiffness / std::sqrt(std::sqrt(smaller * curvature.larger) * correction) / correction;
  const double force = factor * depth * std::sqrt(depth);
  if (force <= punch * depth) return {force, 1.5 * force / depth, 0.4 * force * depth};
  const double crossing = (punch / factor) * (punch / factor);  // m; up to this depth the force follows Hertz
  return {punch * depth, punch, 0.4 * punch * crossing * crossing + 0.5 * punch * (depth * depth - crossing * crossing)};
}

namespace {

constexpr double kRollingStiffness =
    2.25;  // rolling stiffness over normal stiffness * rolling_length^2 (Ai et al., Powder Technology 206, 269 (2011))

/// The change of the relative velocity at the contact by a unit impulse, 1/kg.
struct Mobility {
  double normal = 0;      ///< along the normal
  double tangential = 0;  ///< mean over the directions in the tangent plane
};

/// Adds the mobility of one body.
void add_mobility(const Body& body, const Vector3& arm, const Vector3& n, Mobility& mobility) {
  const Vector3 lever = arm.cross(n);
  const double along = lever.dot(body.inverse_inertia * lever);
  // The trace of [arm]^T J [arm], where [arm] x = arm cross x.
  const double all = body.inverse_inertia.trace() * arm.squaredNorm() - arm.dot(body.inverse_inertia * arm);
  mobility.normal += body.inverse_mass + along;
  mobility.tangential += body.inverse_mass + 0.5 * (all - along);
}

/// Rotates the springs from the last contact frame to the present one: by the smallest rotation between the normals, and about the
/// normal by the mean spin of both bodies.
class FrameTurn {
 public:
  FrameTurn(const Vector3& from, const Vector3& to, double spin)
      : axis_(from.cross(to)), cosine_(from.dot(to)), to_(to), spin_(spin) {}

  Vector3 operator()(const Vector3& spring) const {
    const Vector3 tilted = spring + axis_.cross(spring) + axis_.cross(axis_.cross(spring)) / (1 + std::max(cosine_, -0.5));
    const Vector3 spun = tilted + spin_ * to_.cross(tilted);
    // Correct rounding and the second order of the spin: the spring stays in the plane and keeps its length.
    const Vector3 flat = spun - spun.dot(to_) * to_;
    const double length = flat.norm();
    return length > 0 ? Vector3(spring.norm() / length * flat) : Vector3(Vector3::Zero());
  }

 private:
  Vector3 axis_;
  double cosine_;
  Vector3 to_;
  double spin_;
};

/// Advances the springs by a step. Rotates them and extends them by the motion. If the contact becomes stiffer, their force is
/// kept: new contact area is unstrained, so loading adds no energy to them.
void advance(const Contact& contact, const Vector3& sliding_rate, const Vector3& rolling_rate, double spin, double stiffness,
             double step, ContactHistory& history) {
  const FrameTurn turn(history.has_normal() ? history.normal : contact.normal, contact.normal, spin * step);
  const double kept = history.stiffness > 0 && history.stiffness < stiffness ? history.stiffness / stiffness : 1;
  history.sliding = kept * turn(history.sliding) + step * sliding_rate;
  history.rolling = kept * turn(history.rolling) + step * rolling_rate;
  history.stiffness = stiffness;
}

}  // namespace

ContactForce contact_force(const Contact& contact, const NormalForce& elastic, const ContactMaterial& material, const Body& body1,
                           const Body& body2, double step, ContactHistory& history) {
  const Vector3& n = contact.normal;
  Mobility mobility;
  add_mobility(body1, contact.arm1, n, mobility);
  add_mobility(body2, contact.arm2, n, mobility);
  const auto damper = [&](double stiffness, double inverse_mass) {
    return inverse_mass > 0 ? 2 * material.damping_ratio * std::sqrt(stiffness / inverse_mass) : 0;
  };

  const Vector3 velocity = body1.velocity_at(contact.arm1) - body2.velocity_at(contact.arm2);
  const double approach = velocity.dot(n);
  // The damper of hertz_damping_ratio() uses 5/6 of the tangent stiffness.
  const double damped_stiffness = material.law == NormalLaw::Hertz ? 5.0 / 6 * elastic.stiffness : elastic.stiffness;
  ContactForce found;
  found.normal = std::max(0.0, elastic.force + damper(damped_stiffness, mobility.normal) * approach);
  found.force = -found.normal * n;
  found.energy = elastic.energy;
  if (material.friction == 0 && material.rolling_length == 0) return found;

  const Vector3 sliding_rate = velocity - approach * n;
  const Vector3 turning = body1.angular_velocity - body2.angular_velocity;
  const Vector3 rolling_rate = turning - turning.dot(n) * n;
  const double stiffness = material.tangential_ratio * elastic.stiffness;
  if (step > 0) {
    const double spin = 0.5 * (body1.angular_velocity + body2.angular_velocity).dot(n);
    advance(contact, sliding_rate, rolling_rate, spin, stiffness, step, history);
  }
  const auto write = [&](const SliderForce& slider, Vector3& spring) {
    if (step > 0) spring = slider.spring;
  };
  if (material.friction > 0 && stiffness > 0) {
    const SliderForce friction =
        slide(history.sliding, sliding_rate, stiffness, damper(stiffness, mobility.tangential), material.friction * found.normal);
    write(friction, history.sliding);
    found.force += friction.force;
    found.energy += 0.5 * stiffness * friction.spring.squaredNorm();
    found.slips = friction.slips;
  }
  if (material.rolling_length > 0 && elastic.stiffness > 0) {
    const double k = kRollingStiffness * elastic.stiffness * material.rolling_length * material.rolling_length;
    const double mean_mobility = (body1.inverse_inertia + body2.inverse_inertia).trace() / 3;
    const SliderForce rolling =
        slide(history.rolling, rolling_rate, k, damper(k, mean_mobility), material.rolling_length * found.normal);
    write(rolling, history.rolling);
    found.rolling_torque = rolling.force;
    found.energy += 0.5 * k * rolling.spring.squaredNorm();
  }
  return found;
}

}  // namespace granular
