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

  bool bounces(const Contact& contact) const {
    return contact.surface->bounce > 0 && approach(contact) > std::max(contact.surface->bounce_speed, kStill) && meets(contact);
  }

  /// Whether the pair has bounced. All of its contacts leave together, or a brick would begin to spin.
  bool strike(const Pair& pair) {
    bool has_bounced = false;
    for (int k = 0; k < pair.count; ++k) {
      Contact& contact = system.contact(pair.first + k);
      const bool is_struck = bounces(contact);
      contact.separation_speed = is_struck ? contact.surface->bounce * approach(contact) : 0;
      contact.impact = 0;
      has_bounced = has_bounced || is_struck;
    }
    if (!has_bounced) return false;
    const int sweeps = pair.count > 1 ? kSweepsOfManifold : 1;
    for (int i = 0; i < sweeps; ++i) {
      for (int k = 0; k < pair.count; ++k) solve(system.contact(pair.first + k));
    }
    for (int k = 0; k < pair.count; ++k) rub(system.contact(pair.first + k));
    return true;
  }

  void solve(Contact& contact) {
    if (contact.separation_speed == 0 && !meets(contact)) return;
    const Row& row = contact.normal();
    const double impulse = std::max(0.0, contact.impact + (contact.separation_speed + approach(contact)) / row.mobility);
    system.push(contact, row, impulse - contact.impact);
    contact.impact = impulse;
  }

  void rub(const Contact& contact) {
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
    for (std::size_t k = 0; k < 2; ++k) system.push(contact, contact.rows[k + 1], factor * impulses[k]);
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
