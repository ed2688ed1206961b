#include "kernel/contact_law.hpp"

#include <algorithm>
#include <cmath>

#include "supernormal/contact/hertz.hpp"

namespace granular {

NormalForce hooke_force(const ContactMaterial& material, double depth) {
  const double force = material.stiffness * depth;
  return {force, material.stiffness, 0.5 * force * depth};
}

NormalForce hertz_force(const ContactMaterial& material, double depth, const supernormal::ContactCurvature& curvature,
                        double width) {
  const double punch = face_stiffness(material, width);
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

/// The state of a slider: a spring and damper in series with friction, or with rolling resistance. Units: force and displacement,
/// or torque and angle.
struct SliderForce {
  Vector3 force = Vector3::Zero();   ///< against the motion
  Vector3 spring = Vector3::Zero();  ///< the remaining deflection
  bool slips = false;                ///< whether the limit was reached
};

/// The force of a spring with the deflection `spring` and a damper with the velocity `rate`, at most `limit`. Beyond the limit the
/// spring is shortened, so it pulls back as soon as the motion reverses.
SliderForce slide(const Vector3& spring, const Vector3& rate, double stiffness, double damping, double limit) {
  const Vector3 force = -(stiffness * spring + damping * rate);
  const double size = force.norm();
  if (size <= limit) return {force, spring, false};
  const Vector3 cut = (limit / size) * force;
  return {cut, -(cut + damping * rate) / stiffness, true};
}

constexpr double kRollingStiffness =
    2.25;  // rolling stiffness over normal stiffness * rolling_length^2 (Ai et al., Powder Technology 206, 269 (2011))

/// The change of the relative velocity at the contact by a unit impulse, 1/kg.
struct Mobility {
  double normal = 0;      ///< along the normal
  double tangential = 0;  ///< mean over the directions in the tangent plane
};

/// Adds the mobility of one body.
void add_mobility(const Body& body, const Vector3& from_origin, const Vector3& n, Mobility& mobility) {
  const Vector3 arm = body.from_centre + from_origin;
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

/// What the springs against sliding, twisting and rolling need.
struct Grip {
  double stiffness;   // N/m; of the normal force
  double spread = 0;  // m; lever arm of the twist; 0 for a single point
  Mobility mobility;
};

/// Relative motions of the bodies at a contact.
struct Rates {
  Vector3 sliding;  // m/s; along the normal: of the twist, times its lever arm
  Vector3 rolling;  // rad/s
  double spinning;  // rad/s; relative, about the normal; 0 without resistance to it
  double spin;      // rad/s; mean of both bodies about the normal
};

/// Advances the springs by a step. Rotates them and extends them by the motion. If the contact becomes stiffer, their force is
/// kept: new contact area is unstrained, so loading adds no energy to them.
void advance(const Vector3& normal, const Rates& rates, const Grip& grip, double stiffness, double step, ContactHistory& history) {
  const FrameTurn turn(history.has_normal() ? history.normal : normal, normal, rates.spin * step);
  const double kept = history.stiffness > 0 && history.stiffness < stiffness ? history.stiffness / stiffness : 1;
  const double twist = grip.spread > 0 ? history.sliding.dot(history.normal) : 0;
  if (grip.spread > 0) history.release_twist();
  history.sliding = kept * turn(history.sliding) + step * rates.sliding;
  if (grip.spread > 0) history.sliding += kept * twist * normal;
  const double spun = history.rolling.dot(history.normal);
  history.rolling =
      kept * (turn(history.rolling - spun * history.normal) + spun * normal) + step * (rates.rolling + rates.spinning * normal);
  history.stiffness = stiffness;
}

double damper(const ContactMaterial& material, double stiffness, double inverse_mass) {
  return inverse_mass > 0 ? 2 * material.damping_ratio * std::sqrt(stiffness / inverse_mass) : 0;
}

/// The damper of hertz_damping_ratio() uses 5/6 of the tangent stiffness.
double damped_stiffness(const ContactMaterial& material, double stiffness) {
  return material.law == NormalLaw::Hertz ? 5.0 / 6 * stiffness : stiffness;
}

Mobility find_mobility(const Contact& contact, const Body& body1, const Body& body2) {
  Mobility mobility;
  add_mobility(body1, contact.arm1, contact.normal, mobility);
  add_mobility(body2, contact.arm2, contact.normal, mobility);
  return mobility;
}

/// Adds friction and rolling resistance to a normal force.
void add_sliders(const Contact& contact, const Grip& grip, const ContactMaterial& material, const Body& body1, const Body& body2,
                 double step, ContactHistory& history, ContactForce& found) {
  if (material.friction == 0 && material.rolling_length == 0 && material.spinning_length == 0) return;
  const Vector3& n = contact.normal;
  const Vector3 velocity = body1.velocity_at(contact.arm1) - body2.velocity_at(contact.arm2);
  const Vector3 turning = body1.angular_velocity - body2.angular_velocity;
  Rates rates{velocity - velocity.dot(n) * n, turning - turning.dot(n) * n, material.spinning_length > 0 ? turning.dot(n) : 0,
              0.5 * (body1.angular_velocity + body2.angular_velocity).dot(n)};
  if (grip.spread > 0) rates.sliding += grip.spread * turning.dot(n) * n;
  const double stiffness = material.tangential_ratio * grip.stiffness;
  if (step > 0) advance(n, rates, grip, stiffness, step, history);
  const auto write = [&](const SliderForce& slider, Vector3& spring) {
    if (step > 0) spring = slider.spring;
  };
  if (material.friction > 0 && stiffness > 0) {
    const SliderForce friction = slide(history.sliding, rates.sliding, stiffness,
                                       damper(material, stiffness, grip.mobility.tangential), material.friction * found.normal);
    write(friction, history.sliding);
    const double twist = grip.spread > 0 ? friction.force.dot(n) : 0;
    found.force += grip.spread > 0 ? Vector3(friction.force - twist * n) : friction.force;
    found.torque += grip.spread * twist * n;
    found.energy += 0.5 * stiffness * friction.spring.squaredNorm();
    found.slips = friction.slips;
  }
  if (!(grip.stiffness > 0)) return;
  // Both resist the rotation: `length` is a lever arm of the normal force, `part` what there is of the spring.
  const auto resist = [&](double length, const Vector3& part, const Vector3& rate) -> Vector3 {
    if (length == 0) return part;
    const double k = kRollingStiffness * grip.stiffness * length * length;
    const double mean_mobility = (body1.inverse_inertia + body2.inverse_inertia).trace() / 3;
    const SliderForce slider = slide(part, rate, k, damper(material, k, mean_mobility), length * found.normal);
    found.torque += slider.force;
    found.energy += 0.5 * k * slider.spring.squaredNorm();
    return slider.spring;
  };
  const Vector3 spun = history.rolling.dot(n) * n;
  const Vector3 rolling = resist(material.rolling_length, history.rolling - spun, rates.rolling);
  const Vector3 spinning = resist(material.spinning_length, spun, rates.spinning * n);
  if (step > 0) history.rolling = rolling + spinning;
}

/// A spring of a face contact: a corner, or the deepest point.
struct PointForce {
  Vector3 point;  // m
  Vector3 normal, lateral;
  double force;      // N; elastic
  double pull;       // N; of adhesion
  double stiffness;  // N/m; of the damper
};

/// The springs of a face contact, and what they add up to.
class Pressure {
 public:
  Pressure(const FaceContact& faces, double face_stiffness, const Contact& deepest, const NormalForce& elastic,
           const ContactMaterial& material, const Vector3& origin) {
    const double rest = 1 - faces.share;
    if (rest > 0 && deepest.depth > 0) {
      add({origin + deepest.arm1, deepest.normal, Vector3::Zero(), rest * elastic.force, rest * material.adhesion,
           rest * damped_stiffness(material, elastic.stiffness)});
    }
    for (int k = 0; k < faces.count; ++k) {
      const FaceCorner& corner = faces.corners[static_cast<std::size_t>(k)];
      const double stiffness = faces.share * face_stiffness * corner.weight;
      add({corner.point, corner.normal, corner.lateral, stiffness * corner.depth, faces.share * corner.weight * material.adhesion,
           stiffness});
    }
  }

  double force() const { return force_; }          // N
  double stiffness() const { return stiffness_; }  // N/m

  Vector3 centre() const {
    Vector3 moment = Vector3::Zero();
    for (int k = 0; k < count_; ++k)
      moment += points_[static_cast<std::size_t>(k)].force * points_[static_cast<std::size_t>(k)].point;
    return moment / force_;
  }

  /// The root of the mean square distance of the pressure from an axis, m.
  double spread(const Vector3& centre, const Vector3& axis) const {
    double sum = 0;
    for (int k = 0; k < count_; ++k) {
      const PointForce& one = points_[static_cast<std::size_t>(k)];
      sum += one.force * axis.cross(one.point - centre).squaredNorm();
    }
    return std::sqrt(sum / force_);
  }

  /// Adds the forces on body 1, with the torque about `centre`. `damping` (s) times the stiffness is the damper of each spring.
  void apply(double damping, const Vector3& centre, const Body& body1, const Body& body2, ContactForce& found) const {
    for (int k = 0; k < count_; ++k) {
      const PointForce& one = points_[static_cast<std::size_t>(k)];
      const Vector3 velocity =
          body1.velocity_at(one.point - body1.pose.position) - body2.velocity_at(one.point - body2.pose.position);
      const double normal = std::max(0.0, one.force + damping * one.stiffness * velocity.dot(one.normal));
      const Vector3 force = (one.pull - normal) * one.normal + (one.pull - one.force) * one.lateral;
      found.normal += normal;
      found.elastic += one.force;
      found.adhesion += one.pull;
      found.force += force;
      found.torque += (one.point - centre).cross(force);
    }
  }

 private:
  void add(const PointForce& one) {
    points_[static_cast<std::size_t>(count_++)] = one;
    force_ += one.force;
    stiffness_ += one.stiffness;
  }

  std::array<PointForce, FaceContact::kMostCorners + 1> points_;
  int count_ = 0;
  double force_ = 0, stiffness_ = 0;
};

}  // namespace

ContactForce contact_force(const Contact& contact, const NormalForce& elastic, const ContactMaterial& material, const Body& body1,
                           const Body& body2, double step, ContactHistory& history) {
  const Vector3& n = contact.normal;
  const Mobility mobility = find_mobility(contact, body1, body2);
  const double approach = (body1.velocity_at(contact.arm1) - body2.velocity_at(contact.arm2)).dot(n);
  const double damped = damped_stiffness(material, elastic.stiffness);
  ContactForce found;
  found.normal = std::max(0.0, elastic.force + damper(material, damped, mobility.normal) * approach);
  found.elastic = elastic.force;
  found.adhesion = material.adhesion;
  found.force = (material.adhesion - found.normal) * n;
  found.energy = elastic.energy - material.adhesion * contact.depth;
  add_sliders(contact, {elastic.stiffness, 0, mobility}, material, body1, body2, step, history, found);
  return found;
}

ContactForce face_contact_force(const FaceContact& faces, double face_stiffness, const NormalForce& elastic,
                                const ContactMaterial& material, const Body& body1, const Body& body2, double step,
                                Contact& contact, ContactHistory& history) {
  const Pressure pressure(faces, face_stiffness, contact, elastic, material, body1.pose.position);
  if (pressure.force() > 0) {
    const Vector3 centre = pressure.centre();
    contact.arm1 = centre - body1.pose.position;
    contact.arm2 = centre - body2.pose.position;
  }
  const Vector3 centre = body1.pose.position + contact.arm1;
  const Mobility mobility = find_mobility(contact, body1, body2);
  const double stiffness = pressure.stiffness();
  ContactForce found;
  pressure.apply(stiffness > 0 ? damper(material, stiffness, mobility.normal) / stiffness : 0, centre, body1, body2, found);

  // The forces by the weights, which depend on the poses, too.
  const double of_faces = 0.5 * face_stiffness * faces.mean_square - material.adhesion * faces.mean;
  const double of_point = elastic.energy - material.adhesion * contact.depth;
  const Vector3 by_share = (of_point - of_faces) * faces.share_by_way;
  found.force += by_share;
  found.torque += (of_point - of_faces) * faces.share_by_turn + (faces.origin - centre).cross(by_share) -
                  faces.share * (0.5 * face_stiffness * faces.turning - material.adhesion * faces.turning_of_mean);
  found.energy = faces.share * of_faces + (1 - faces.share) * of_point;

  const double grip = faces.share * face_stiffness + (1 - faces.share) * elastic.stiffness;
  const double spread = pressure.force() > 0 ? pressure.spread(centre, contact.normal) : 0;
  if (step > 0 && spread == 0) history.release_twist();
  add_sliders(contact, {grip, spread, mobility}, material, body1, body2, step, history, found);
  return found;
}

double face_stiffness(const ContactMaterial& material, double width) {
  return material.law == NormalLaw::Hooke ? material.stiffness : 2 * material.stiffness * width;
}

}  // namespace granular
