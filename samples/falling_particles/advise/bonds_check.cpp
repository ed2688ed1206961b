// The check of the bonds of a scene in its world at the start.

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "doubts.hpp"
#include "refusals.hpp"
#include "world/placement.hpp"

namespace falling_particles {
namespace {

/// The largest relative stiffness of bonds for each iteration of the solver (Bonds::stiffness). bonds.md has the measurement.
constexpr double kStiffnessPerIteration = 10;

[[noreturn]] void refuse_bond(const Scene& scene, const std::string& text) { throw InputError(scene.called + ": " + text); }

/// What the radius of a bond follows from.
struct Radius {
  std::string key;
  double value;
  const char* unit;
  unsigned line = 0;  // of BondRule::file, if the radius is there
};

Radius radius_of(const Bond& bond, const BondRule& rule) {
  const auto pair = std::ranges::find_if(rule.pairs, [&](const BondedPair& named) {
    return named.second == bond.second && (rule.wall || named.first == bond.first) && named.radius;
  });
  if (pair != rule.pairs.end()) return {"radius_m", bond.radius, " m", pair->line};
  if (rule.radius) return {"bond.radius", *rule.radius, " m"};
  return {"bond.relative_radius", rule.relative_radius, ""};
}

/// The largest factor on the radii of the bonds of the worst grain, or on the radius of its stiffest bond, with which the grain has
/// the allowed stiffness. 0 if there is none above 1e-6.
double allowed_factor(const Bonds& bonds, double allowed, bool single) {
  const auto [relative, grain, bond] = bonds.stiffness();
  const auto is_allowed = [&, grain = grain, bond = bond](double factor) {
    return bonds.relative_stiffness(grain, factor, single ? std::optional(bond) : std::nullopt) <= allowed;
  };
  double least = 1e-6, most = 1;
  if (!is_allowed(least)) return 0;
  while (most / least > 1.0001) {
    const double middle = std::sqrt(least * most);
    (is_allowed(middle) ? least : most) = middle;
  }
  return least;
}

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

// bonds.md, "The step": a step damps a motion of angular frequency w by w step / 2 of the critical damping. The fastest motion of a
// grain has (w step)^2 = Stiffness::relative, against neighbours of its own mass that move the other way.
void add_doubts_about_bonds(const Scene& scene, std::vector<std::string>& doubts) {
  const auto breaks = [](const BondRule& rule) {
    return std::min(rule.tensile_strength, rule.shear_strength) < BondRule::kUnbreakable;
  };
  if (std::ranges::none_of(scene.bonds, breaks)) return;
  Random random(scene.seed);
  const World world(scene, place(scene, random));
  const auto [relative, grain, index] = world.bonds()->stiffness();
  if (!(relative > 0)) return;
  const BondRule& rule = scene.bonds[world.bonds()->all()[index].rule];
  const double by_step = std::sqrt(relative) / 2;
  if (!breaks(rule) || by_step <= rule.damping) return;
  const std::string remedy =
      rule.damping > 0 ? "time.step up to " + rounded(scene.time.step * rule.damping / by_step) + " s would damp as much as that"
                       : "half the time.step damps half as much";
  doubts.push_back("bond \"" + rule.name + "\": a step damps its fastest motions by " + rounded(by_step) +
                   " of the critical damping, besides bond.damping = " + shortest(rule.damping) +
                   ", so impacts break fewer bonds; " + remedy);
}

void refuse_stiff_bonds(const World& world, int iterations) {
  const Scene& scene = world.scene();
  const auto [relative, grain, index] = world.bonds()->stiffness();
  const double allowed = kStiffnessPerIteration * iterations;
  if (relative <= allowed) return;
  const Bond& bond = world.bonds()->all()[index];
  const BondRule& rule = scene.bonds[bond.rule];
  const Radius radius = radius_of(bond, rule);
  std::string enough = "bond.modulus up to " + rounded(rule.modulus * allowed / relative) + " Pa, ";
  if (const double factor = allowed_factor(*world.bonds(), allowed, radius.line > 0); factor > 0) {
    enough += radius.key + " up to " + rounded(factor * radius.value) + radius.unit + ", ";
  }
  enough += "or time.step up to " + rounded(scene.time.step * std::sqrt(allowed / relative)) + " s";
  const double most = std::ceil(relative / kStiffnessPerIteration);
  if (most <= Solver::kMostIterations) enough += ", or solver.iterations from " + shortest(most) + " on";
  const std::string text = "bond \"" + rule.name + "\" is too stiff for grain " + std::to_string(grain) + " (" +
                           world.grains()[grain].kind->name + "): bond.modulus is " + shortest(rule.modulus) + " Pa, and " +
                           radius.key + " is " + rounded(radius.value) + radius.unit + "; allowed: " + enough;
  if (radius.line > 0) throw InputError(rule.file.string(), radius.line, text);
  refuse_bond(scene, text);
}

}  // namespace falling_particles
