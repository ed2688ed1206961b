// Springs and dampers as rows of ODE's solver.
//
// A row with softness cfm and target velocity u enforces v + cfm f = u, where v is the velocity after the step. So its force is
// f = A - B v with B = 1 / cfm and A = B u. ODE's soft ERP and CFM make this the implicit Euler method. Here A is the force at the
// start of the step, and B is only the implicit half of the damper. ODE moves positions with the new velocity. So this is the
// leapfrog method, which adds no damping. Let m be the mass of the contact and s = h^2 k / m. Leapfrog is stable for s < 4, and a
// contact lasts pi / sqrt(s) steps.
//
// With A - theta h k v the method goes from leapfrog (theta = 0) to implicit Euler (theta = 1). It is stable for
// s (1 - 2 theta) < 4, and damps by 1 / (1 + theta s) a step. theta = (s - limit) / (s + 1) becomes positive where a contact lasts
// ten steps. It is stable for any s, also for a body with ten such contacts at once. No impact gains more than 0.5 %, wherever in a
// step it begins.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "effects/elastic_geom.hpp"
#include "effects/motion.hpp"
#include "effects/pair_material.hpp"
#include "supernormal/contact/contact_curvature.hpp"
#include "supernormal/contact/hertz.hpp"

namespace supernormal::effects {
namespace {

// A contact lasts half a period of the spring.
constexpr double kStiffest = (std::numbers::pi / kLeastContactSteps) * (std::numbers::pi / kLeastContactSteps);
// Least B, in mass / step. The row is then as good as rigid, and ODE's solver can still divide by B.
constexpr double kLeastDamper = 1e-6;

struct Spring {
  double force;    ///< N, at the largest depth
  double tangent;  ///< N/m
  double damping;  ///< N s/m
};

/// kg; the effective mass of the contact at the point where the spring's force acts, the depth-weighted mean of the contacts.
double effective_mass(const Patch& patch) {
  const Vector3 point = patch.centre_of_depth();
  const Vector3 n = patch.normal();
  const double mobilities = mobility(patch.body1, point, n) + mobility(patch.body2, point, n);
  return mobilities > 0 ? 1 / mobilities : 0;
}

/// Moves contacts that carry no force behind the others.
void leave_out_idle(double damping, Patch& patch) {
  if (damping > 0) return;
  patch.kept = static_cast<int>(move_to_front(patch.contacts, [](const dContact& contact) { return contact.geom.depth > 0; }));
}

void set_rows(const Spring& spring, double mass, Patch& patch) {
  const double h = patch.step;
  double depths = 0;
  for (const dContact& contact : patch.contacts) depths += contact.geom.depth;
  const double stiffness = mass > 0 ? h * h * spring.tangent / mass : 0;
  const double implicit = std::max(0.0, (stiffness - kStiffest) / (stiffness + 1));
  if (implicit > 0) patch.coarse = patch.kept;
  // A stronger damper would reverse the velocity within the step. It is made fully implicit.
  const double new_half = spring.damping * h > 2 * mass ? 1 - mass / (spring.damping * h) : 0.5;
  const Vector3 n = patch.normal();
  for (std::size_t k = 0; k < patch.contacts.size(); ++k) {
    dContact& contact = patch.contacts[k];
    const Vector3 point = ode::to_vector(contact.geom.pos);
    const double velocity = n.dot(velocity_at(patch.body1, point) - velocity_at(patch.body2, point));
    const double share = depths > 0 ? contact.geom.depth / depths : 0;
    const double damper = spring.damping > 0 ? patch.fraction_at(k) * spring.damping : 0;
    const double A = share * spring.force - (1 - new_half) * damper * velocity;
    const double B = std::max(share * implicit * h * spring.tangent + new_half * damper, kLeastDamper * mass / h);
    contact.surface.soft_cfm = ode::to_real(B > 0 ? 1 / B : 0);
    contact.surface.motionN = ode::to_real(B > 0 ? A / B : 0);
  }
  leave_out_idle(spring.damping, patch);
}

}  // namespace

void set_spring(const PairMaterial& pair, Patch& patch) {
  const double depth = patch.greatest_depth();
  set_rows({pair.stiffness * depth, pair.stiffness, pair.damping}, effective_mass(patch), patch);
}

void set_hertz(const PairMaterial& pair, Patch& patch) {
  const Vector3 n = patch.normal();
  const dGeomID geom1 = patch.geom1();
  const dGeomID geom2 = patch.geom2();
  const ContactCurvature curvature = find_contact_curvature(curvature_of(geom1, -n) + curvature_of(geom2, n), n);
  const double depth = patch.greatest_depth();
  const double width = std::min(mean_half_extent(geom1), mean_half_extent(geom2));
  Spring spring{2 * pair.elastic_modulus * width * depth, 2 * pair.elastic_modulus * width, 0};  // the force of the flat punch
  // Beyond an aspect ratio of a thousand, Hertz's ellipse counts as a line contact.
  const double smaller = std::max(curvature.smaller, 1e-6 * curvature.larger);
  if (smaller > 0 && depth > 0) {
    const double radius = 1 / std::sqrt(smaller * curvature.larger);
    const double reduced = depth / hertz_correction(curvature.larger / smaller);
    const double force = 4.0 / 3 * pair.elastic_modulus * std::sqrt(radius * reduced) * reduced;
    if (force < spring.force) spring = {force, 1.5 * force / depth, 0};
  }
  const double mass = effective_mass(patch);
  spring.damping = 2 * pair.damping_ratio * std::sqrt(5.0 / 6 * mass * spring.tangent);
  set_rows(spring, mass, patch);
}

}  // namespace supernormal::effects
