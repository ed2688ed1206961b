#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "load_sections.hpp"
#include "model/container.hpp"
#include "model/wall.hpp"

namespace falling_particles {
namespace {

namespace fx = supernormal::effects;

/// Its depth is relative to the grains in scenes, which the library does not know.
constexpr std::string_view kSurfaceLayer = "surface_layer";

/// The key `walls` of a section.
struct WallsKey {
  const char* effect;
  const char* parameter;  ///< whose value it gives for contacts of grains and walls
  const char* text;
};
constexpr std::array<WallsKey, 3> kWalls = {
    {{"friction", "coefficient", "; walls (0, 100], of grains on walls, as among grains without it"},
     {"rolling_resistance", "rolling", "; walls [0, 1e3] m, rolling on walls, as among grains without it"},
     {"restitution", "coefficient", "; walls (0, 1], of grains on walls, as among grains without it"}}};

const WallsKey* find_walls(std::string_view effect) {
  const auto* const found = std::ranges::find(kWalls, effect, &WallsKey::effect);
  return found == kWalls.end() ? nullptr : found;
}

/// The keys of the section of an effect.
std::vector<std::string> keys_of(const std::string& name) {
  std::vector<std::string> keys = {"enabled"};
  if (name == kSurfaceLayer) return {"enabled", "relative_depth"};
  fx::read_effect(name, [&](const fx::Parameter& parameter) {
    keys.emplace_back(parameter.name);
    return std::vector<double>();
  });
  if (find_walls(name) != nullptr) keys.emplace_back("walls");
  return keys;
}

/// None without the section, and with `enabled = false` in it.
std::optional<TomlTable> find_section(const TomlTable& root, const std::string& name) {
  std::optional<TomlTable> table = root.find_table(name, keys_of(name));
  if (table && table->has("enabled") && !table->boolean("enabled")) table.reset();
  return table;
}

/// Reads an effect from its section. The library checks the ranges. `instead` has another key for a parameter: {parameter, key}.
fx::Effect read_section(const TomlTable& table, const fx::Description& effect,
                        std::pair<std::string_view, const char*> instead = {}) {
  const Interval allowed = Interval::finite(effect.parameters);
  return fx::read_effect(effect.name, [&](const fx::Parameter& parameter) -> std::vector<double> {
    const char* const key = parameter.name == instead.first ? instead.second : parameter.name;
    if (parameter.has_default && !table.has(key)) return {};
    switch (parameter.kind) {
      case fx::Parameter::Kind::Vector:
        return table.numbers(key, 3, allowed);
      case fx::Parameter::Kind::Whole:
        return {static_cast<double>(table.integer(key, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()))};
      default:
        return {table.number(key, allowed)};
    }
  });
}

void select(fx::Effect& effect, const fx::MaterialSelector& contacts) {
  std::visit(
      [&](auto& e) {
        if constexpr (requires { e.on; }) e.on = contacts;
      },
      effect);
}

/// Appends the effects of a section.
void read_effect(const TomlTable& table, const fx::Description& effect, double smallest_half_axis, std::vector<fx::Effect>& list) {
  const std::string name = effect.name;
  if (name == kSurfaceLayer) {
    const double relative = table.number("relative_depth", Interval::positive(0.1, "(relative to the smallest half-axis)"));
    list.emplace_back(fx::SurfaceLayer{relative * smallest_half_axis});
    return;
  }
  list.push_back(read_section(table, effect));
  if (name == "anisotropic_friction") select(list.back(), fx::MaterialSelector::of(kGrainMaterial));
  const WallsKey* const walls = find_walls(name);
  if (walls == nullptr || !table.has("walls")) return;
  list.push_back(read_section(table, effect, {walls->parameter, "walls"}));
  select(list.back(), kGrainOnWall);
}

std::vector<fx::Effect> read_effects(const TomlTable& root, double smallest_half_axis) {
  std::vector<fx::Effect> list;
  for (const fx::Description& effect : fx::descriptions()) {
    const std::optional<TomlTable> table = find_section(root, effect.name);
    if (table) read_effect(*table, effect, smallest_half_axis, list);
  }
  return list;
}

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
    table.refuse("sub_steps", " is [" + shortest(count[0]) + ", " + shortest(count[1]) +
                                  "]; allowed: two whole numbers, the least and the most of a step");
  }
  accuracy.least = static_cast<int>(count[0]);
  accuracy.most = static_cast<int>(count[1]);
  return accuracy;
}

}  // namespace

std::string scene_parameters(const fx::Description& effect) {
  const std::string name = effect.name;
  if (name == kSurfaceLayer) return "relative_depth (0, 0.1], of the smallest half-axis of all grains";
  const WallsKey* const walls = find_walls(name);
  return std::string(effect.parameters) + (walls == nullptr ? "" : walls->text);
}

std::vector<std::string> effect_sections() {
  std::vector<std::string> names;
  for (const fx::Description& description : fx::descriptions()) names.emplace_back(description.name);
  return names;
}

std::vector<fx::Effect> load_effects(const TomlTable& root, double smallest_half_axis, double step, fx::Solver solver) {
  std::vector<fx::Effect> list = read_effects(root, smallest_half_axis);
  try {
    const fx::Effects compiled(list, step, solver);
  } catch (const fx::BadEffect& error) {
    if (!root.has(error.effect())) root.fail("", error.what());
    const TomlTable section = root.table(error.effect());
    section.fail(error.parameter(), error.what());
  }
  return list;
}

void load_wall_effects(const TomlTable& root, Scene& scene) {
  add_wall_effects(scene.walls, scene.effects);
  try {
    const fx::Effects compiled(scene.effects, scene.time.step, scene.solver.solves_contacts());
  } catch (const fx::BadEffect& error) {
    for (const auto& [table, index] : tables_of_walls(root, scene)) {
      if (!table.has("restitution")) continue;
      table.refuse("restitution", " besides an effect of the scene: " + error.reason() + "; allowed: a wall without it");
    }
    throw;
  }
}

Solver load_solver(const TomlTable& root) {
  const TomlTable table = root.table("solver");
  table.refuse_unknown_keys({"kind", "iterations", "erp", "cfm", "sag", "sub_steps"});
  const bool is_stepper = is_of_stepper(table);
  for (const char* key : {"iterations", "erp", "cfm", "sag", "sub_steps"}) {
    const bool is_its_key = std::string(key).starts_with('s');
    if (!table.has(key) || is_its_key == is_stepper) continue;
    table.refuse(key, std::string(" is given with solver.kind = \"") + (is_stepper ? kStepper : kQuickstep) +
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
