#include "stepper/sub_steps.hpp"

#include <algorithm>
#include <cmath>

namespace supernormal::stepper {
namespace {

// A sub-step is longer or shorter than the last by this factor at most: what a load has pressed in is thrown if its spring jumps.
constexpr double kChange = 1.2;

// Sub-steps, times the root of `heaviest_`, in which it changes by a factor of e at most. A heavy body on light ones swings on
// their springs within a quarter of them; springs that stiffen and soften as fast make it hop higher and higher (README).
constexpr double kSwing = 40;

// Within these factors it stays as it is, because the sag goes with its square: one that flickers shakes what rests.
constexpr double kLittleLess = 0.95;
constexpr double kLittleMore = 1.3;

// rad; two bodies whose contact moves turn no farther against each other in a sub-step.
constexpr double kLargestTurn = 0.03;

}  // namespace

int SubSteps::choose(double time, double step) {
  const double longest = step / accuracy.least;
  const double shortest = step / accuracy.most;
  const double change = duration_ == 0 ? kChange : std::min(kChange, std::exp(time / (duration_ * kSwing * std::sqrt(heaviest_))));
  if (duration_ == 0) {
    duration_ = shortest;  // the first loads are not known
  } else {
    double next = std::clamp(needed_, shortest, longest);
    if (next > kLittleLess * duration_ && next < kLittleMore * duration_) next = duration_;
    duration_ = std::max(std::clamp(next, duration_ / change, duration_ * change), shortest);
  }
  const double duration = std::min({duration_, longest, std::max(turning_, shortest)});
  constexpr double kRounding = 1e-9;
  const int count = std::max(1, static_cast<int>(std::ceil(time / duration - kRounding)));
  spring_ = std::max(time / count, spring_ / change);
  return count;
}

void SubSteps::learn(const System& system, double time) {
  double stiffness = 0;  // 1/s^2; the square of the frequency that the sag needs
  double spin = 0;       // rad/s
  heaviest_ = 1;
  const auto weigh = [&](const Link& link) {
    const auto [heavy, light] = std::minmax({system.body1(link).inverse_mass, system.body2(link).inverse_mass});
    if (heavy > 0) heaviest_ = std::max(heaviest_, light / heavy);
  };
  for (const Contact& contact : system.contacts) {
    stiffness = std::max(stiffness, contact.normal().total / time * contact.normal().mobility / (accuracy.sag * contact.size));
    weigh(contact);
    if (contact.moving < 0 || contact.normal().total == 0) continue;
    spin = std::max(spin, (system.body1(contact).angular_velocity - system.body2(contact).angular_velocity).norm());
  }
  for (const Joint* const joint : system.joints) {
    const double size = system.size(*joint);
    weigh(*joint);
    for (int i = 0; i < joint->held(); ++i) {
      const Row& row = joint->rows()[std::size_t(i)];
      stiffness =
          std::max(stiffness, std::abs(row.total) / time * row.mobility / (accuracy.sag * (joint->is_linear(i) ? size : 1)));
    }
  }
  needed_ = stiffness > 0 ? kPhase / std::sqrt(stiffness) : kAny;
  turning_ = spin > 0 ? kLargestTurn / spin : kAny;
}

}  // namespace supernormal::stepper
