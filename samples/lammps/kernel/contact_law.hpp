// The contact force between two overlapping bodies: an elastic normal force, adhesion, friction, and resistance to rolling and
// spinning.
#pragma once

#include <Eigen/Core>

#include "kernel/body.hpp"
#include "kernel/contact_material.hpp"
#include "kernel/face_contact.hpp"
#include "supernormal/contact/contact_curvature.hpp"

namespace granular {

/// The history of a pair, in the world frame, for body 1.
struct ContactHistory {
  Vector3 normal = Vector3::Zero();   ///< of the last query, from body 1 to body 2; zero if there was none
  Vector3 sliding = Vector3::Zero();  ///< m; deflection of the tangential spring; of faces, along the normal: of the twist spring
  Vector3 rolling = Vector3::Zero();  ///< rad; deflection of the rolling spring; along the normal: of the spinning spring
  double stiffness = 0;               ///< N/m; of the tangential spring in the last step

  static constexpr int kSize = 10;  ///< how many numbers store one history

  bool has_normal() const { return normal != Vector3::Zero(); }
  void release_springs() {
    sliding.setZero();
    rolling.setZero();
    stiffness = 0;
  }
  /// Faces that no longer meet have no twist spring.
  void release_twist() { sliding -= sliding.dot(normal) * normal; }

  /// Reads and writes a history as an array of numbers.
  static ContactHistory load(const double* values) {
    return {Vector3::Map(values), Vector3::Map(values + 3), Vector3::Map(values + 6), values[9]};
  }
  void store(double* values) const {
    Vector3::Map(values) = normal;
    Vector3::Map(values + 3) = sliding;
    Vector3::Map(values + 6) = rolling;
    values[9] = stiffness;
  }
};

/// The state of a spring at some depth.
struct NormalForce {
  double force = 0;      ///< N
  double stiffness = 0;  ///< N/m; derivative of the force by the depth
  double energy = 0;     ///< J; integral of the force over the depth
};

/// Hooke's law.
NormalForce hooke_force(const ContactMaterial& material, double depth);

/// Hertz's law for a depth (m, > 0) and a relative curvature. The radius of flat faces is infinite. The force therefore grows no
/// faster than under a flat punch of half the `width` (m), the mean half-extent of the smaller body.
NormalForce hertz_force(const ContactMaterial& material, double depth, const supernormal::ContactCurvature& curvature,
                        double width);

/// The contact of two bodies, in the world frame.
struct Contact {
  Vector3 normal;  ///< unit, from body 1 to body 2
  Vector3 arm1;    ///< m; from the centre of body 1 to the contact point
  Vector3 arm2;    ///< m; from the centre of body 2 to the contact point
  double depth;    ///< m; >= 0
};

/// The result of the contact law.
struct ContactForce {
  Vector3 force = Vector3::Zero();   ///< N; on body 1, at the contact point; the opposite acts on body 2
  Vector3 torque = Vector3::Zero();  ///< N m; on body 1, in addition to the force's; the opposite acts on body 2
  double normal = 0;                 ///< N; >= 0; without adhesion
  double elastic = 0;                ///< N; of the springs along the normal; the dampers have the rest of `normal`
  double adhesion = 0;               ///< N; the pull of adhesion
  double energy = 0;                 ///< J; in the springs
  bool slips = false;                ///< whether friction is at its limit
};

/// The contact force for the elastic normal force `elastic`:
/// - a damped normal force, which never pulls;
/// - adhesion, a constant pull. It presses the bodies together, so it raises the limits of friction, rolling and spinning
/// (Derjaguin,
///   Muller and Toporov, J. Colloid Interface Sci. 53, 314 (1975));
/// - Coulomb friction with a tangential spring, which rotates with the contact;
/// - a rolling spring and a spinning spring.
/// `history` holds the springs and the normal at `step` (s) earlier, and is advanced. With a step of 0 it is only read.
ContactForce contact_force(const Contact& contact, const NormalForce& elastic, const ContactMaterial& material, const Body& body1,
                           const Body& body2, double step, ContactHistory& history);

/// The contact force where faces meet:
/// - the corners share it. Each has its weight in the stiffness `face_stiffness` (N/m), and in the damper;
/// - the deepest point, with `elastic`, has what FaceContact::share leaves;
/// - adhesion has the energy of a constant pull over the mean depth, so it acts in the middle of the region, its Steiner point;
/// - friction acts at the centre of pressure, with the spring of the pair and a twist spring about the normal. The spread of the
///   pressure is the lever arm of the twist, and both springs have one common limit.
/// The contact point of `contact` becomes the centre of pressure.
ContactForce face_contact_force(const FaceContact& faces, double face_stiffness, const NormalForce& elastic,
                                const ContactMaterial& material, const Body& body1, const Body& body2, double step,
                                Contact& contact, ContactHistory& history);

/// The stiffness (N/m) of two flat faces: Hooke's, or the flat punch of hertz_force().
double face_stiffness(const ContactMaterial& material, double width);

}  // namespace granular
