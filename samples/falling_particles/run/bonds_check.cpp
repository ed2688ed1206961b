// The check of the bonds of a scene in its world at the start.

#include <algorithm>
#include <cmath>

#include "base/input_error.hpp"
#include "base/interval.hpp"
#include "doubts.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

/// The largest relative stiffness of bonds for each iteration of the solver (Bonds::stiffness). bonds.md has the measurement.
constexpr double kStiffnessPerIteration = 10;

/// The least length of a bond, relative to the smallest half-axis. A shorter one has no direction: it is the rounding of centres
/// that are at one place. Twice, half, none: 1e-12 m of a bead of 1 mm are refused, refused, and too stiff for any step.
constexpr double kLeastLength = 1e-6;

[[noreturn]] void refuse_bond(const Scene& scene, const std::string& text) {
  throw InputError(scene.files.front().string() + ": " + text);
}

/// Bonds by `touching` may join grains whose centres are at one place, or on the surface of a part.
void refuse_zero_lengths(const Scene& scene, const World& world) {
  for (const Bond& bond : world.bonds()->all()) {
    const BondRule& rule = scene.bonds[bond.rule];
    const Grain& second = world.grains()[bond.second];
    const double least = second.smallest_half_axis() * kLeastLength;
    if (bond.rest.length() >= least) continue;
    const std::string first = rule.wall ? "part " + scene.walls[*rule.wall].name : "grain " + std::to_string(bond.first);
    refuse_bond(scene, "bond \"" + rule.name + "\": the length from " + first + " to grain " + std::to_string(bond.second) + " (" +
                           second.kind->name + ") is " + shortest(bond.rest.length()) + " m; allowed: from " + rounded(least) +
                           " m on, between two centres, or the centre of a grain and the surface of a part");
  }
}

}  // namespace

void refuse_bad_bonds(const Scene& scene) {
  Random random(scene.seed);
  const World world(scene, place(scene, random));
  const Bonds& bonds = *world.bonds();
  for (std::size_t rule = 0; rule < scene.bonds.size(); ++rule) {
    if (std::ranges::any_of(bonds.all(), [rule](const Bond& bond) { return bond.rule == rule; })) continue;
    const BondRule& unused = scene.bonds[rule];
    refuse_bond(scene, "bond \"" + unused.name + "\" bonds nothing: no " + (unused.wall ? "grain and part" : "two grains") +
                           " of the start are closer than bond.touching = " + shortest(*unused.touching) +
                           " of the smallest half-axis, or other bonds have them; allowed: a start with such pairs");
  }
  refuse_zero_lengths(scene, world);
  const auto [relative, grain, rule] = bonds.stiffness();
  const double allowed = kStiffnessPerIteration * scene.solver.iterations;
  if (relative <= allowed) return;
  const BondRule& stiff = scene.bonds[rule];
  const double iterations = std::ceil(relative / kStiffnessPerIteration);
  refuse_bond(scene,
              "bond \"" + stiff.name + "\" is too stiff for grain " + std::to_string(grain) + " (" +
                  world.grains()[grain].kind->name + "): bond.modulus is " + shortest(stiff.modulus) + " Pa; allowed: up to " +
                  rounded(stiff.modulus * allowed / relative) + " Pa, or time.step up to " +
                  rounded(scene.time.step * std::sqrt(allowed / relative)) + " s" +
                  (iterations > Solver::kMostIterations ? "" : ", or solver.iterations from " + shortest(iterations) + " on"));
}

}  // namespace falling_particles
