// The check of the bonds of a scene in its world at the start.

#include <algorithm>
#include <cmath>

#include "base/input_error.hpp"
#include "base/interval.hpp"
#include "doubts.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

/// The largest relative stiffness of bonds for each iteration of the solver (Bonds::stiffness). bonds.md has the measurement.
constexpr double kStiffnessPerIteration = 10;

[[noreturn]] void refuse_bond(const Scene& scene, const std::string& text) { throw InputError(scene.path + ": " + text); }

}  // namespace

void refuse_bad_bonds(const World& world) {
  const Scene& scene = world.scene();
  const Bonds& bonds = *world.bonds();
  for (std::size_t rule = 0; rule < scene.bonds.size(); ++rule) {
    if (std::ranges::any_of(bonds.all(), [rule](const Bond& bond) { return bond.rule == rule; })) continue;
    const BondRule& unused = scene.bonds[rule];
    refuse_bond(scene, "bond \"" + unused.name + "\" bonds nothing: no " + (unused.wall ? "grain and part" : "two grains") +
                           " of the start are closer than bond.touching = " + shortest(*unused.touching) +
                           " of the smallest half-axis, or other bonds have them; allowed: a start with such pairs");
  }
  refuse_stiff_bonds(world, scene.solver.iterations);
}

void refuse_stiff_bonds(const World& world, int iterations) {
  const Scene& scene = world.scene();
  const auto [relative, grain, rule] = world.bonds()->stiffness();
  const double allowed = kStiffnessPerIteration * iterations;
  if (relative <= allowed) return;
  const BondRule& stiff = scene.bonds[rule];
  const double enough = std::ceil(relative / kStiffnessPerIteration);
  refuse_bond(scene, "bond \"" + stiff.name + "\" is too stiff for grain " + std::to_string(grain) + " (" +
                         world.grains()[grain].kind->name + "): bond.modulus is " + shortest(stiff.modulus) +
                         " Pa; allowed: up to " + rounded(stiff.modulus * allowed / relative) + " Pa, or time.step up to " +
                         rounded(scene.time.step * std::sqrt(allowed / relative)) + " s" +
                         (enough > Solver::kMostIterations ? "" : ", or solver.iterations from " + shortest(enough) + " on"));
}

}  // namespace falling_particles
