// Restitution.
#include <algorithm>
#include <cmath>

#include "stepper/sweep.hpp"

namespace supernormal::stepper {
namespace {

constexpr int kMostRounds = 100;       // a cradle of n balls takes n
constexpr int kSweepsOfManifold = 30;  // four points of a brick: 1e-6 of the impulse is left

struct Striker {
  System& system;
  double time;

  double approach(const Contact& contact) const {
    return contact.surface().motion[0] - contact.normal().direction.dot(system.velocity(contact));
  }

  bool meets(const Contact& contact) const { return contact.gap <= time * approach(contact); }

  /// m/s; the velocity for this sub-step of a pair that bounces in it, 0 if it does not. Velocities of sub-steps are those of a
  /// parabola half a sub-step away, and the pair turns back where the sub-step begins, before it touches. Without both it would
  /// gain energy. A pair that would rise less than its gap, as one at rest, closes the gap first.
  double leaving(const Contact& contact) const {
    const Surface& surface = contact.surface();
    const double arriving = approach(contact);
    if (!(surface.bounce > 0 && arriving > surface.bounce_speed && contact.gap <= time * arriving)) return 0;
    const Vector3 falling = system.body2(contact).acceleration() - system.body1(contact).acceleration();
    const double acceleration = contact.normal().direction.dot(falling);
    const double here = std::max(0.0, arriving - acceleration * time / 2);
    const double below = 2 * acceleration * std::max(0.0, contact.gap);
    const double square = surface.bounce * surface.bounce * (here * here + below) - below;
    return std::max(0.0, std::sqrt(std::max(0.0, square)) - acceleration * time / 2);
  }

  /// Whether the pair has bounced. All of its contacts leave together, or a brick would begin to spin.
  bool strike(const Pair& pair) {
    const std::span<Contact> contacts = system.contacts_of(pair);
    bool has_bounced = false;
    system.impacts.clear();
    for (const Contact& contact : contacts) {
      system.impacts.push_back({leaving(contact)});
      has_bounced = has_bounced || system.impacts.back().speed > 0;
    }
    if (!has_bounced) return false;
    for (Body* const body : {&system.body1(contacts.front()), &system.body2(contacts.front())}) body->turn_inertia();
    for (Contact& contact : contacts) set_responses(system, contact);
    const int sweeps = pair.count > 1 ? kSweepsOfManifold : 1;
    for (int i = 0; i < sweeps; ++i) {
      for (std::size_t k = 0; k < contacts.size(); ++k) solve(contacts[k], system.impacts[k]);
    }
    for (std::size_t k = 0; k < contacts.size(); ++k) rub(contacts[k], system.impacts[k].impulse);
    return true;
  }

  void solve(const Contact& contact, Impact& impact) {
    if (impact.speed == 0 && !meets(contact)) return;
    const double before = impact.impulse;
    impact.impulse = std::max(0.0, before + (impact.speed + approach(contact)) / contact.normal().mobility);
    system.push(contact, contact.normal(), impact.impulse - before);
  }

  void rub(Contact& contact, double impact) {
    if (impact == 0) return;
    const Vector3 velocity = system.velocity(contact);
    std::array<double, 2> impulses{}, limits{};
    for (std::size_t k = 0; k < 2; ++k) {
      limits[k] = contact.surface().friction[k].of_impact(impact);
      if (limits[k] == 0) continue;
      impulses[k] = contact.tangent_mass * (contact.surface().motion[k + 1] - velocity.dot(contact.rows[k + 1].direction));
    }
    limit_to_ellipse(impulses, limits);
    system.push_across(contact, impulses[0], impulses[1]);
    contact.impact += impact;
    for (std::size_t k = 0; k < 2; ++k) contact.rows[k + 1].total += impulses[k];
  }
};

}  // namespace

void bounce(System& system, double time) {
  if (!system.has_bounces) return;
  Striker striker{system, time};
  bool has_bounced = true;
  for (int round = 0; has_bounced && round < kMostRounds; ++round) {
    has_bounced = false;
    for (const Pair& pair : system.pairs) has_bounced = striker.strike(pair) || has_bounced;
  }
  for (Contact& contact : system.contacts) {
    const Surface& surface = contact.surface();
    contact.will_bounce = surface.bounce > 0 && striker.approach(contact) > surface.bounce_speed && !striker.meets(contact);
  }
}

}  // namespace supernormal::stepper
