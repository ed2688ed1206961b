// Measures the cost of each effect, switched on one at a time on the same bed of grains. Prints a Markdown table and writes a CSV
// file for figures.gp.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "common/random.hpp"
#include "model/scene.hpp"
#include "world/placement.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

namespace {

namespace fx = supernormal::effects;
using falling_particles::Placement;
using falling_particles::Scene;
using falling_particles::Stepper;
using falling_particles::World;

/// The mean cost of a step of a scene.
struct Outcome {
  double seconds = 0;  // s, whole step
  double set_up = 0;   // s, preparation of contacts and forces: the passes of the effects, and the joints
  double solver = 0;   // s, dWorldQuickStep
  double contacts = 0;
  double rows = 0;
};

struct Variant {
  std::string name;
  std::vector<fx::Effect> added;
  int base = 0;  ///< index of the variant to compare with
  Outcome best{};
};

constexpr int kRigid = 0;
constexpr int kRough = 1;

/// The first two are the bases of the comparisons.
std::vector<Variant> variants() {
  const fx::Friction friction{0.4, {}};
  return {
      {"gravity alone", {}, kRigid},
      {"friction", {friction}, kRigid},
      {"anisotropic friction", {fx::AnisotropicFriction{0.4, 0.2, {1, 0, 0}, {}}}, kRigid},
      {"restitution", {fx::Restitution{0.5, 0.05, {}}}, kRigid},
      {"compliance", {fx::Compliance{300, 0.05, {}}}, kRigid},
      {"hertz", {fx::Hertz{1e6, 0.3, 0.7, {}}}, kRigid},
      {"adhesion", {fx::Adhesion{1e-3, {}}}, kRigid},
      {"quadratic drag", {fx::QuadraticDrag{1.2, 0.5}}, kRigid},
      {"Stokes drag", {fx::StokesDrag{1.8e-5}}, kRigid},
      {"buoyancy, half of the bed", {fx::Buoyancy{1000, 0.01}}, kRigid},
      {"damping", {fx::Damping{1, 1}}, kRigid},
      {"friction and spinning resistance", {friction, fx::RollingResistance{0, 1e-4, {}}}, kRough},
      {"friction and rolling resistance", {friction, fx::RollingResistance{1e-4, 0, {}}}, kRough},
      {"friction, rolling and spinning", {friction, fx::RollingResistance{1e-4, 1e-4, {}}}, kRough},
  };
}

/// Runs the scene to its end and returns the final placements of its grains.
std::vector<Placement> settle(const Scene& scene) {
  common::Random random(scene.seed);
  std::vector<Placement> placements = place(scene, random);
  const World world(scene, placements);
  Stepper stepper(world, scene);
  for (int i = 0; i < scene.time.steps(); ++i) stepper.step();
  for (std::size_t i = 0; i < placements.size(); ++i) {
    placements[i].position = world.grains()[i].position();
    placements[i].quaternion = world.grains()[i].quaternion();
  }
  return placements;
}

Outcome total_of(const World& world, const Stepper& stepper) {
  const falling_particles::StepCosts& costs = stepper.costs();
  const double set_up = costs.contact_setup.seconds(), solver = costs.solver.seconds();
  Outcome sum{costs.collision.seconds() + set_up + solver, set_up, solver, static_cast<double>(costs.contacts)};
  for (const fx::Cost& cost : world.effects().costs()) sum.rows += static_cast<double>(cost.rows);
  return sum;
}

/// Steps from these placements, from rest, with other effects. Use few steps, so that the bed does not change.
Outcome run(Scene scene, const std::vector<Placement>& start, const std::vector<fx::Effect>& effects, int steps) {
  scene.effects = effects;
  const World world(scene, start);
  Stepper stepper(world, scene);
  stepper.step();  // does the one-time work
  const Outcome before = total_of(world, stepper);
  for (int i = 0; i < steps; ++i) stepper.step();
  Outcome mean = total_of(world, stepper);
  for (double Outcome::*part : {&Outcome::seconds, &Outcome::set_up, &Outcome::solver, &Outcome::contacts, &Outcome::rows}) {
    mean.*part = (mean.*part - before.*part) / steps;
  }
  return mean;
}

/// Takes the best of several rounds. In each round all variants take a turn, so that other work of the machine affects all of them.
void measure(std::vector<Variant>& all, const Scene& scene, int rounds, int steps) {
  const auto start = settle(scene);
  for (int round = 0; round < rounds; ++round) {
    for (Variant& variant : all) {
      std::vector<fx::Effect> effects = {*scene.gravity()};
      effects.insert(effects.end(), variant.added.begin(), variant.added.end());
      const Outcome outcome = run(scene, start, effects, steps);
      Outcome& best = variant.best;
      if (round == 0) best = outcome;
      best.seconds = std::min(best.seconds, outcome.seconds);
      best.set_up = std::min(best.set_up, outcome.set_up);
      best.solver = std::min(best.solver, outcome.solver);
    }
  }
}

void print(const std::vector<Variant>& all) {
  std::printf("| effect | contacts | rows per contact | µs per step | set-up | solver | over | µs more per contact |\n");
  std::printf("|---|---:|---:|---:|---:|---:|---|---:|\n");
  for (const Variant& variant : all) {
    const Outcome& o = variant.best;
    const Variant& base = all[static_cast<std::size_t>(variant.base)];
    const bool is_base = &base == &variant;
    std::printf("| %s | %.0f | %.2f | %.0f | %.0f | %.0f | %s | ", variant.name.c_str(), o.contacts, o.rows / o.contacts,
                1e6 * o.seconds, 1e6 * o.set_up, 1e6 * o.solver, is_base ? "–" : base.name.c_str());
    if (is_base) {
      std::printf("– |\n");
    } else {
      // The cost of collision is the same for all variants and is omitted.
      const auto own = [](const Outcome& of) { return (of.set_up + of.solver) / of.contacts; };
      std::printf("%.2f |\n", 1e6 * (own(o) - own(base.best)));
    }
  }
}

void write_csv(const std::string& path, const std::vector<Variant>& all) {
  std::ofstream out(path);
  out << "effect,set_up,solver,rest\n";
  for (const Variant& variant : all) {
    const Outcome& o = variant.best;
    out << '"' << variant.name << "\"," << o.set_up << ',' << o.solver << ',' << o.seconds - o.set_up - o.solver << '\n';
  }
  if (!out.flush()) throw std::runtime_error("cannot write \"" + path + '"');
}

int run_program(int argc, char** argv) {
  CLI::App app("Times the steps of one bed of grains with one effect after the other.", "effects_cost");
  std::string scene_path;
  std::string csv;
  int rounds = 5;
  int steps = 100;
  app.add_option("scene", scene_path, "scene with the bed (samples/falling_particles/costs/effects_cost/bed.toml)")->required();
  app.add_option("--csv", csv, "file for figures.gp");
  app.add_option("--rounds", rounds, "of which the best counts")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--steps", steps, "in each round")->capture_default_str()->check(CLI::Range(1, 100000));
  CLI11_PARSE(app, argc, argv);
  const Scene scene = falling_particles::load_scene(scene_path);
  if (scene.gravity() == nullptr) throw std::runtime_error("the scene has no [gravity], but a bed needs it");
  std::vector<Variant> all = variants();
  measure(all, scene, rounds, steps);
  print(all);
  if (!csv.empty()) write_csv(csv, all);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "effects_cost: %s\n", error.what());
    return 1;
  }
}
