#include "leaks.hpp"

#include <array>
#include <span>

#include "base/interval.hpp"

namespace falling_particles {
namespace {

std::string in_brackets(std::span<const double> numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "[" : ", ") + shortest(number);
  return text + "]";
}

Leak leak_of(const Grain& grain, std::size_t index, double time) {
  const dReal* v = dBodyGetLinearVel(grain.body);
  return {time, index, grain.kind->name, grain.position(), grain.quaternion(), {v[0], v[1], v[2]}};
}

}  // namespace

std::string describe(const Leak& leak) {
  return "grain " + std::to_string(leak.grain) + " (" + leak.kind + ") left the container at t = " + shortest(leak.time) +
         " s: position " + in_brackets(leak.position) + " m, quaternion " + in_brackets(leak.quaternion) + ", velocity " +
         in_brackets(leak.velocity) + " m/s";
}

LeakWatch::LeakWatch(const World& world, const Scene& scene)
    : world_(world), scene_(scene), has_leaked_(world.grains().size(), false) {}

void LeakWatch::after_step(double time) {
  has_leaked_.resize(world_.grains().size(), false);
  for (const Grain& grain : world_.present()) {
    const std::size_t i = world_.index_of(grain);
    if (has_leaked_[i] || is_inside(scene_, grain.position())) continue;
    has_leaked_[i] = true;
    ++count_;
    if (!first_) first_ = leak_of(grain, i, time);
  }
}

}  // namespace falling_particles
