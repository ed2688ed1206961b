// The section [solver], and what a scene cannot have with the stepper.
#include <cmath>
#include <string>
#include <variant>

#include "load_sections.hpp"
#include "model/periodic.hpp"

namespace falling_particles {
namespace {

constexpr const char* kQuickstep = "quickstep";
constexpr const char* kStepper = "stepper";

bool is_of_stepper(const TomlTable& table) { return table.has("kind") && table.choice("kind", {kQuickstep, kStepper}) == kStepper; }

Accuracy read_accuracy(const TomlTable& table) {
  constexpr double kMostSubSteps = 1e6;
  Accuracy accuracy;
  if (table.has("sag")) accuracy.sag = table.number("sag", Interval::closed(1e-12, 1, ""));
  if (!table.has("sub_steps")) return accuracy;
  const std::vector<double> count = table.numbers("sub_steps", 2, Interval::closed(1, kMostSubSteps, ""));
  if (count[0] > count[1] || count[0] != std::floor(count[0]) || count[1] != std::floor(count[1])) {
    table.fail("sub_steps", table.full_name("sub_steps") + " is [" + shortest(count[0]) + ", " + shortest(count[1]) +
                                "]; allowed: two whole numbers, the least and the most of a step");
  }
  accuracy.least = static_cast<int>(count[0]);
  accuracy.most = static_cast<int>(count[1]);
  return accuracy;
}

}  // namespace

Solver load_solver(const TomlTable& root) {
  const TomlTable table = root.table("solver");
  table.refuse_unknown_keys({"kind", "iterations", "erp", "cfm", "sag", "sub_steps"});
  const bool is_stepper = is_of_stepper(table);
  for (const char* key : {"iterations", "erp", "cfm", "sag", "sub_steps"}) {
    const bool is_its_key = std::string(key).starts_with('s');
    if (!table.has(key) || is_its_key == is_stepper) continue;
    table.fail(key, table.full_name(key) + " is given with solver.kind = \"" + (is_stepper ? kStepper : kQuickstep) +
                        "\", which has none; allowed besides kind: " + (is_stepper ? "sag, sub_steps" : "iterations, erp, cfm"));
  }
  if (is_stepper) return {.stepper = read_accuracy(table)};
  return {static_cast<int>(table.integer("iterations", 1, Solver::kMostIterations)),
          table.number("erp", Interval::closed(0, 1, "")), table.number("cfm", Interval::closed(0, 1, "s/kg"))};
}

void refuse_for_stepper(const TomlTable& root, const Scene& scene) {
  if (!scene.solver.stepper) return;
  const auto refuse = [&](const std::string& what) {
    const TomlTable table = root.table("solver");
    table.fail("kind", "solver.kind is \"stepper\" in a scene with " + what +
                           ", which only quickstep moves; allowed: \"quickstep\", or a scene without");
  };
  if (!scene.bonds.empty()) refuse("[[bond]]");
  if (std::holds_alternative<Periodic>(scene.container) || is_any(scene.periodic)) refuse("periodic axes");
  for (const Wall& wall : scene.walls) {
    if (wall.drive) refuse("a drive, of " + wall.called());
  }
}

}  // namespace falling_particles
