#include "stepper/impacts.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal::stepper {
namespace {

constexpr double kStill = 1e-9;        // m/s; slower is rounding
constexpr int kMostRounds = 100;       // a cradle of n balls takes n
constexpr int kSweepsOfManifold = 30;  // four points of a brick: 1e-6 of the impulse is left

struct Impact {
  System& system;
  double time;

  double approach(const Contact& contact) const { return contact.normal().motion - system.velocity(contact, contact.normal()); }

  bool meets(const Contact& contact) const { return system.gap(contact) <= time * approach(contact); }

  /// m/s; the velocity for this sub-step of a pair that bounces in it, 0 if it does not. Velocities of sub-steps are those of a
  /// parabola half a sub-step away, and the pair turns back where the sub-step begins, before it touches. Without both it would
  /// gain energy. A pair that would rise less than its gap, as one at rest, closes the gap first.
  double leaving(const Contact& contact) const {
    const Surface& surface = *contact.surface;
    const double arriving = approach(contact);
    if (!(surface.bounce > 0 && arriving > std::max(surface.bounce_speed, kStill) && meets(contact))) return 0;
    const Vector3 falling = system.body2(contact).acceleration() - system.body1(contact).acceleration();
    const double acceleration = contact.normal().direction.dot(falling);
    const double here = std::max(0.0, arriving - acceleration * time / 2);
    const double below = 2 * acceleration * std::max(0.0, system.gap(contact));
    const double square = surface.bounce * surface.bounce * (here * here + below) - below;
    return std::max(0.0, std::sqrt(std::max(0.0, square)) - acceleration * time / 2);
  }

  /// Whether the pair has bounced. All of its contacts leave together, or a brick would begin to spin.
  bool strike(const Pair& pair) {
    bool has_bounced = false;
    for (int k = 0; k < pair.count; ++k) {
      Contact& contact = system.contact(pair.first + k);
      contact.separation_speed = leaving(contact);
      contact.impact = 0;
      has_bounced = has_bounced || contact.separation_speed > 0;
    }
    if (!has_bounced) return false;
    const int sweeps = pair.count > 1 ? kSweepsOfManifold : 1;
    for (int i = 0; i < sweeps; ++i) {
      for (int k = 0; k < pair.count; ++k) solve(system.contact(pair.first + k));
    }
    for (int k = 0; k < pair.count; ++k) {
      Contact& contact = system.contact(pair.first + k);
      contact.of_impacts += contact.impact * contact.normal().direction;
      rub(contact);
    }
    return true;
  }

  void solve(Contact& contact) {
    if (contact.separation_speed == 0 && !meets(contact)) return;
    const Row& row = contact.normal();
    const double impulse = std::max(0.0, contact.impact + (contact.separation_speed + approach(contact)) / row.mobility);
    system.push(contact, row, impulse - contact.impact);
    contact.impact = impulse;
  }

  void rub(Contact& contact) {
    if (contact.impact == 0) return;
    std::array<double, 2> impulses{};
    double beyond = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Row& row = contact.rows[k + 1];
      const double largest = contact.surface->friction[k].of_impact(contact.impact);
      if (largest == 0) continue;
      impulses[k] = contact.tangent_mass * (row.motion - system.velocity(contact, row));
      beyond += impulses[k] / largest * (impulses[k] / largest);
    }
    const double factor = beyond > 1 ? 1 / std::sqrt(beyond) : 1;
    for (std::size_t k = 0; k < 2; ++k) {
      system.push(contact, contact.rows[k + 1], factor * impulses[k]);
      contact.of_impacts += factor * impulses[k] * contact.rows[k + 1].direction;
    }
  }
};

}  // namespace

void bounce(System& system, double time) {
  Impact impact{system, time};
  for (int round = 0; round < kMostRounds; ++round) {
    bool has_bounced = false;
    for (const Pair& pair : system.pairs) has_bounced = impact.strike(pair) || has_bounced;
    if (!has_bounced) return;
  }
}

}  // namespace supernormal::stepper
