#include "doubts.hpp"

#include <algorithm>
#include <cmath>

#include "common/interval.hpp"
#include "common/random.hpp"
#include "world/placement.hpp"
#include "world/world.hpp"

namespace falling_particles {
namespace {

/// Adds a doubt about a container a thousand grains wide: a box that holds one grain, typed in mm.
void add_doubts_about_units(const Scene& scene, std::vector<std::string>& doubts) {
  constexpr double kMillimetres = 1000;
  double widest = 0;  // m, of the grains
  for (const GrainCount& entry : scene.kinds) {
    if (scene.has_grains_of(entry)) widest = std::max(widest, entry.largest_scale() * entry.kind.sieve_size());
  }
  const Rectangle plan = plan_of(scene.container);
  const double narrower = std::min(plan.width[0], plan.width[1]);
  if (!(widest > 0 && narrower >= kMillimetres * widest)) return;
  doubts.push_back("the container is " + rounded(narrower) + " m wide, " + rounded(narrower / widest) +
                   " times the largest grain, " + rounded(widest) + " m: lengths are in m; millimetres would give this factor");
}

}  // namespace

std::vector<std::string> doubts_about(const Scene& scene) {
  std::vector<std::string> doubts;
  for (const auto add : {add_doubts_about_step, add_doubts_about_loads, add_doubts_about_walls, add_doubts_about_leaks,
                         add_doubts_about_units, add_doubts_about_bonds}) {
    add(scene, doubts);
  }
  return doubts;
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

}  // namespace falling_particles
