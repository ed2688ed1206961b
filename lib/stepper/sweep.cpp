#include "stepper/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal::stepper {
namespace {

// Relative to the size: an impulse that moves a contact by more in a sub-step is an impact. One pass leaves a fifth of it to wrong
// corners, so a brick that lands flat would spin (README).
constexpr double kStruck = 2e-4;
constexpr int kMostPasses = 15;

using Pairwise = std::array<double, 2>;

/// How far an impulse follows the slip along an axis: by the square of its limit, so that the force in the ellipse of the limits is
/// the one that dissipates most (effects.hpp, AnisotropicFriction). An axis without a limit is for itself.
double metric(double limit, double largest) {
  return limit == largest || std::isinf(largest) ? 1 : limit / largest * (limit / largest);
}

class Sweeper {
 public:
  Sweeper(System& system, const SweepSettings& settings) : system_(system), settings_(settings) {}

  /// Solves everything, and in later passes what holds or touches a body that the last one struck. Whether a body was struck.
  bool pass(int number) const {
    // Contacts have the last word: what overlaps harms more than a joint that gives way.
    const std::size_t joints = system_.joints.size();
    for (std::size_t i = 0; i < joints; ++i) {
      Joint& joint = *system_.joints[at(i, joints)];
      if (struck(joint) >= number) joint.solve(system_, settings_);
    }
    bool has_struck = false;
    for (std::size_t i = 0; i < system_.pairs.size(); ++i) {
      const std::span<Contact> contacts = system_.contacts_of(system_.pairs[at(i, system_.pairs.size())]);
      const Contact& first = contacts.front();
      if (struck(first) < number || !solve(contacts)) continue;
      has_struck = true;
      for (Body* const body : {&system_.body1(first), &system_.body2(first)}) body->struck = body->is_dynamic() ? number + 1 : 0;
    }
    return has_struck;
  }

 private:
  /// In this order forwards, or backwards.
  std::size_t at(std::size_t i, std::size_t count) const { return settings_.is_backward ? count - 1 - i : i; }

  int struck(const Link& link) const { return std::max(system_.body1(link).struck, system_.body2(link).struck); }

  /// Solves all contacts of a pair. Whether it was struck.
  bool solve(std::span<Contact> contacts) const {
    const std::size_t count = contacts.size();
    bool is_struck = false;
    for (std::size_t k = 0; k < count; ++k) is_struck = solve_normal(contacts[at(k, count)]) || is_struck;
    for (std::size_t k = 0; k < count; ++k) {
      solve_friction(contacts[at(k, count)]);
      solve_rolling(contacts[at(k, count)]);
    }
    return is_struck;
  }

  bool solve_normal(Contact& contact) const {
    if (contact.will_bounce) return false;  // closed by a correction, it would stop the body
    Row& row = contact.normal();
    const Surface& surface = contact.surface();
    const double gap = contact.gap - surface.motion[0] * settings_.elapsed;  // from a surface that moves
    double velocity = row.direction.dot(system_.velocity(contact)) - surface.motion[0];
    Softness softness;
    if (gap > 0) {
      // What may bounce in the next sub-step keeps its velocity, and what may meet in the next step, which has other contacts: an
      // edge between two tiles is none there.
      if (!settings_.is_biased && row.impulse == 0 && (surface.bounce > 0 || settings_.is_last)) return false;
      velocity += gap / settings_.time;
    } else if (settings_.is_biased || surface.cfm > 0) {
      softness = *contact.softness;
      const double overlap = std::min(std::max(0.0, -gap - contact.layer), softness.deepest * contact.size);
      velocity -= std::min(softness.rate * overlap, settings_.fastest_out);
    }
    if (gap <= 0 || row.impulse > 0) velocity -= centring(contact).dot(row.direction);
    const double change = -softness.mass * velocity / row.mobility - softness.keep * (row.impulse + pending(row));
    const double impulse = std::max(0.0, row.impulse + change);
    const double pushed = impulse - row.impulse;
    if (pushed == 0) return false;  // most contacts ahead have none
    system_.push(contact, row, pushed);
    row.impulse = impulse;
    return std::abs(pushed) * row.mobility * settings_.time > kStruck * contact.size;
  }

  void solve_friction(Contact& contact) const {
    if (contact.is_idle()) return;
    const double normal = contact.normal().impulse;
    const Surface& surface = contact.surface();
    const Pairwise limits = {surface.friction[0].in(acting(contact), normal), surface.friction[1].in(acting(contact), normal)};
    const double largest = std::max(limits[0], limits[1]);
    double mass = contact.tangent_mass;
    if (surface.slips()) mass /= 1 + mass * std::max(surface.slip[0], surface.slip[1]) / settings_.time;
    const Vector3 velocity = system_.velocity(contact) - centring(contact);
    Pairwise impulses{};
    for (std::size_t k = 0; k < 2; ++k) {
      if (limits[k] == 0) continue;
      const Row& row = contact.rows[k + 1];
      double sliding = velocity.dot(row.direction) - surface.motion[k + 1];
      if (surface.slips()) sliding += surface.slip[k] / settings_.time * (row.impulse + pending(row));
      impulses[k] = row.impulse - mass * metric(limits[k], largest) * sliding;
    }
    limit_to_ellipse(impulses, limits);
    system_.push_across(contact, impulses[0] - contact.rows[1].impulse, impulses[1] - contact.rows[2].impulse);
    for (std::size_t k = 0; k < 2; ++k) contact.rows[k + 1].impulse = impulses[k];
  }

  void solve_rolling(const Contact& contact) const {
    Rolling* const torques = system_.rolling_of(contact);
    if (torques == nullptr) return;
    for (std::size_t k = 0; k < 3; ++k) {
      Row& row = (*torques)[k];
      if (!(row.mobility > 0)) continue;
      const double largest = contact.surface().rolling[k].in(acting(contact), contact.normal().impulse);
      const double impulse = std::clamp(row.impulse - row.direction.dot(system_.spin(contact)) / row.mobility, -largest, largest);
      system_.turn(contact, row, impulse - row.impulse);
      row.impulse = impulse;
    }
  }

  /// s; in which its impulse acts so far.
  double acting(const Contact& contact) const { return settings_.time * (settings_.is_biased ? contact.part_before : 1); }

  /// N s; what of the last impulse acts after the positions.
  double pending(const Row& row) const { return settings_.is_biased ? row.later : 0; }

  Vector3 centring(const Contact& contact) const {
    return settings_.is_biased && contact.moving >= 0 ? system_.centring[std::size_t(contact.moving)] : Vector3::Zero();
  }

  System& system_;
  const SweepSettings& settings_;
};

}  // namespace

void limit_to_ellipse(Pairwise& impulses, const Pairwise& limits) {
  double beyond = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double part = impulses[k] == 0 ? 0 : impulses[k] / limits[k];
    beyond += part * part;
  }
  if (beyond <= 1) return;
  const double factor = 1 / std::sqrt(beyond);
  for (std::size_t k = 0; k < 2; ++k) impulses[k] *= std::isinf(limits[k]) ? 1 : factor;
}

void sweep(System& system, const SweepSettings& settings) {
  for (Contact& contact : system.contacts) {
    system.ride(contact, settings.is_biased ? settings.time / 2 : 0);
    if (!settings.is_biased) system.update_gap(contact);
  }
  for (Body& body : system.bodies) body.struck = 0;
  const Sweeper sweeper(system, settings);
  for (int pass = 0; pass < kMostPasses && sweeper.pass(pass);) ++pass;
}

}  // namespace supernormal::stepper
