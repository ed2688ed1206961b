#include "stepper/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal::stepper {
namespace {

using Pairwise = std::array<double, 2>;

/// How far an impulse follows the slip along an axis: by the square of its limit, so that the force in the ellipse of the limits is
/// the one that dissipates most (effects.hpp, AnisotropicFriction). An axis without a limit is for itself.
double metric(double limit, double largest) {
  return limit == largest || std::isinf(largest) ? 1 : limit / largest * (limit / largest);
}

/// Scales the impulses into the ellipse of the limits; one that has no limit leaves the other alone.
void limit(Pairwise& impulses, const Pairwise& limits) {
  double beyond = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (impulses[k] != 0) beyond += impulses[k] / limits[k] * (impulses[k] / limits[k]);
  }
  if (beyond <= 1) return;
  for (std::size_t k = 0; k < 2; ++k) {
    if (!std::isinf(limits[k])) impulses[k] /= std::sqrt(beyond);
  }
}

class Sweeper {
 public:
  Sweeper(System& system, const SweepSettings& settings) : system_(system), settings_(settings) {}

  void solve_normal(Contact& contact) const {
    Row& row = contact.normal();
    const double gap = system_.gap(contact) - row.motion * settings_.elapsed;  // from a surface that moves
    double velocity = system_.velocity(contact, row) - row.motion;
    Softness softness;
    if (gap > 0) {
      // What may bounce in the next sub-step keeps its velocity.
      if (!is_biased() && contact.surface->bounce > 0 && row.impulse == 0) return;
      velocity += gap / settings_.time;
    } else if (is_biased() || contact.surface->cfm > 0) {
      softness = contact.softness;
      const double overlap = std::min(std::max(0.0, -gap - contact.layer), contact.deepest);
      velocity -= std::min(softness.rate * overlap, settings_.fastest_out);
    }
    if (is_biased() && (gap <= 0 || row.impulse > 0)) velocity -= row.centring;
    const double change = -softness.mass * velocity / row.mobility - softness.keep * (row.impulse + pending(row));
    add(contact, row, std::max(0.0, row.impulse + change));
  }

  void solve_friction(Contact& contact) const {
    const double normal = contact.normal().impulse;
    if (normal == 0 && contact.rows[1].impulse == 0 && contact.rows[2].impulse == 0) return;
    const Surface& surface = *contact.surface;
    const double time = is_biased() ? settings_.time * contact.part_before : settings_.time;
    const Pairwise limits = {surface.friction[0].in(time, normal), surface.friction[1].in(time, normal)};
    const double largest = std::max(limits[0], limits[1]);
    const double slip = std::max(surface.slip[0], surface.slip[1]) / settings_.time;  // 1/kg
    const double mass = contact.tangent_mass / (1 + contact.tangent_mass * slip);
    Pairwise impulses{};
    for (std::size_t k = 0; k < 2; ++k) {
      if (limits[k] == 0) continue;
      const Row& row = contact.rows[k + 1];
      const double velocity = system_.velocity(contact, row) - row.motion - (is_biased() ? row.centring : 0) +
                              surface.slip[k] / settings_.time * (row.impulse + pending(row));
      impulses[k] = row.impulse - mass * metric(limits[k], largest) * velocity;
    }
    limit(impulses, limits);
    for (std::size_t k = 0; k < 2; ++k) add(contact, contact.rows[k + 1], impulses[k]);
  }

  void solve_rolling(const Contact& contact) const {
    Rolling* const torques = system_.rolling_of(contact);
    if (torques == nullptr) return;
    const double time = is_biased() ? settings_.time * contact.part_before : settings_.time;
    for (std::size_t k = 0; k < 3; ++k) {
      Row& row = (*torques)[k];
      const double largest = contact.surface->rolling[k].in(time, contact.normal().impulse);
      if (row.mobility > 0)
        add(contact, row, std::clamp(row.impulse - system_.velocity(contact, row) / row.mobility, -largest, largest));
    }
  }

 private:
  bool is_biased() const { return settings_.kind == Sweep::Biased; }

  /// N s; what of the last impulse acts after the positions.
  double pending(const Row& row) const { return is_biased() ? row.later : 0; }

  void add(const Contact& contact, Row& row, double impulse) const {
    if (impulse == row.impulse) return;  // most contacts ahead have none
    system_.push(contact, row, impulse - row.impulse);
    row.impulse = impulse;
  }

  System& system_;
  const SweepSettings& settings_;
};

}  // namespace

void sweep(System& system, const SweepSettings& settings) {
  const Sweeper sweeper(system, settings);
  const auto pairs = static_cast<int>(system.pairs.size());
  for (int i = 0; i < pairs; ++i) {
    const Pair& pair = system.pairs[static_cast<std::size_t>(settings.is_backward ? pairs - 1 - i : i)];
    const auto contact = [&](int k) -> Contact& {
      return system.contact(pair.first + (settings.is_backward ? pair.count - 1 - k : k));
    };
    for (int k = 0; k < pair.count; ++k) sweeper.solve_normal(contact(k));
    for (int k = 0; k < pair.count; ++k) {
      sweeper.solve_friction(contact(k));
      sweeper.solve_rolling(contact(k));
    }
  }
}

}  // namespace supernormal::stepper
