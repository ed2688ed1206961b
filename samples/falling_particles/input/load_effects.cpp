#include "load_effects.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "load_sections.hpp"
#include "model/material.hpp"

namespace falling_particles {
namespace {

namespace fx = supernormal::effects;

constexpr bool kSpeculativeByDefault = false;  // whether a scene without [speculative_contacts] has them

/// The list of effects. Each reader adds the effects of its section.
using List = std::vector<fx::Effect>;

/// The section of an effect. The library checks the ranges.
class Section {
 public:
  Section(TomlTable table, const char* ranges) : table_(std::move(table)), allowed_(Interval::finite(ranges)) {}

  bool has(const char* key) const { return table_.has(key); }
  double number(const char* key) const { return table_.number(key, allowed_); }
  double number_or(const char* key, double otherwise) const { return has(key) ? number(key) : otherwise; }
  supernormal::Vector3 vector(const char* key) const {
    const std::vector<double> v = table_.numbers(key, 3, allowed_);
    return supernormal::Vector3(v[0], v[1], v[2]);
  }
  const TomlTable& table() const { return table_; }

 private:
  TomlTable table_;
  Interval allowed_;
};

/// None without the section, and with `enabled = false` in it.
std::optional<Section> find_section(const TomlTable& root, const std::string& name, std::vector<std::string> keys) {
  const auto description = std::ranges::find(fx::descriptions(), name, &fx::Description::name);
  keys.emplace_back("enabled");
  std::optional<TomlTable> table = root.find_table(name, std::move(keys));
  if (!table || (table->has("enabled") && !table->boolean("enabled"))) return std::nullopt;
  return Section(*std::move(table), description->parameters);
}

class Reader {
 public:
  Reader(const TomlTable& root, double smallest_half_axis) : root_(root), smallest_half_axis_(smallest_half_axis) {}

  List read() {
    read_contact();
    read_bodies();
    read_world();
    return list_;
  }

 private:
  void read_contact() {
    if (const auto section = find_section(root_, "friction", {"coefficient", "walls"})) {
      list_.emplace_back(fx::Friction{section->number("coefficient"), {}});
      if (section->has("walls")) list_.emplace_back(fx::Friction{section->number("walls"), kGrainOnWall});
    }
    if (const auto section = find_section(root_, "anisotropic_friction", {"along", "across", "direction"})) {
      list_.emplace_back(fx::AnisotropicFriction{section->number("along"), section->number("across"), section->vector("direction"),
                                                 fx::MaterialSelector::of(kGrainMaterial)});
    }
    if (const auto section = find_section(root_, "rolling_resistance", {"rolling", "spinning", "walls"})) {
      const double spinning = section->number_or("spinning", 0);
      list_.emplace_back(fx::RollingResistance{section->number_or("rolling", 0), spinning, {}});
      if (section->has("walls")) list_.emplace_back(fx::RollingResistance{section->number("walls"), spinning, kGrainOnWall});
    }
    if (const auto section = find_section(root_, "restitution", {"coefficient", "threshold", "walls"})) {
      const double threshold = section->number_or("threshold", 0);
      list_.emplace_back(fx::Restitution{section->number("coefficient"), threshold, {}});
      if (section->has("walls")) list_.emplace_back(fx::Restitution{section->number("walls"), threshold, kGrainOnWall});
    }
    if (const auto section = find_section(root_, "compliance", {"stiffness", "damping"})) {
      list_.emplace_back(fx::Compliance{section->number("stiffness"), section->number_or("damping", 0), {}});
    }
    if (const auto section = find_section(root_, "hertz", {"youngs_modulus", "poisson_ratio", "restitution"})) {
      list_.emplace_back(
          fx::Hertz{section->number("youngs_modulus"), section->number("poisson_ratio"), section->number_or("restitution", 1), {}});
    }
    if (const auto section = find_section(root_, "adhesion", {"pull_off"})) {
      list_.emplace_back(fx::Adhesion{section->number("pull_off"), {}});
    }
  }

  void read_bodies() {
    if (const auto section = find_section(root_, "gravity", {"acceleration"})) {
      list_.emplace_back(fx::Gravity{section->vector("acceleration")});
    }
    if (const auto section = find_section(root_, "quadratic_drag", {"density", "coefficient"})) {
      list_.emplace_back(fx::QuadraticDrag{section->number("density"), section->number("coefficient")});
    }
    if (const auto section = find_section(root_, "stokes_drag", {"viscosity"})) {
      list_.emplace_back(fx::StokesDrag{section->number("viscosity")});
    }
    if (const auto section = find_section(root_, "buoyancy", {"density", "level"})) {
      list_.emplace_back(fx::Buoyancy{section->number("density"), section->number("level")});
    }
    if (const auto section = find_section(root_, "damping", {"linear", "angular"})) {
      list_.emplace_back(fx::Damping{section->number_or("linear", 0), section->number_or("angular", 0)});
    }
  }

  void read_world() {
    if (const auto section = find_section(root_, "auto_disable", {"linear", "angular", "time", "samples"})) {
      fx::AutoDisable effect{section->number("linear"), section->number("angular"), section->number_or("time", 0), 10};
      if (section->has("samples")) effect.samples = static_cast<int>(section->table().integer("samples", 1, 1000));
      list_.emplace_back(effect);
    }
    if (const auto section = find_section(root_, "max_correcting_velocity", {"velocity"})) {
      list_.emplace_back(fx::MaxCorrectingVelocity{section->number("velocity")});
    }
    if (const auto section = find_section(root_, "surface_layer", {"relative_depth"})) {
      const double relative =
          section->table().number("relative_depth", Interval::positive(0.1, "(relative to the smallest half-axis)"));
      list_.emplace_back(fx::SurfaceLayer{relative * smallest_half_axis_});
    }
    if (has_speculative_contacts()) list_.emplace_back(fx::SpeculativeContacts{});
  }

  // A compression works by overlaps, which speculative contacts prevent.
  bool has_speculative_contacts() const {
    if (!root_.has("speculative_contacts")) return kSpeculativeByDefault && !root_.has("compression");
    return find_section(root_, "speculative_contacts", {}).has_value();
  }

  const TomlTable& root_;
  double smallest_half_axis_;
  List list_;
};

}  // namespace

std::string scene_parameters(const fx::Description& effect) {
  const std::string name = effect.name;
  if (name == "surface_layer") return "relative_depth (0, 0.1], of the smallest half-axis of all grains";
  if (name == "speculative_contacts") {
    return std::string("none; a scene without the section has ") + (kSpeculativeByDefault ? "them, but for a compression" : "none");
  }
  std::string text = effect.parameters;
  if (name == "friction") text += "; walls (0, 100], of grains on walls, as among grains without it";
  if (name == "rolling_resistance") text += ", 0 without it; walls [0, 1e3] m, rolling on walls, as among grains without it";
  if (name == "restitution") text += ", 0 without it; walls (0, 1], of grains on walls, as among grains without it";
  if (name == "compliance") text += ", 0 without it";
  if (name == "hertz") text += ", 1 without it";
  if (name == "damping") text += ", 0 without it";
  if (name == "auto_disable") text += "; time 0 and samples 10 without them";
  return text;
}

std::vector<std::string> effect_sections() {
  std::vector<std::string> names;
  for (const fx::Description& description : fx::descriptions()) names.emplace_back(description.name);
  return names;
}

std::vector<fx::Effect> load_effects(const TomlTable& root, double smallest_half_axis, double step, fx::Solver solver) {
  const List list = Reader(root, smallest_half_axis).read();
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
      table.fail("restitution", table.full_name("restitution") + " besides an effect of the scene: " + error.reason() +
                                    "; allowed: a wall without it");
    }
    throw;
  }
}

}  // namespace falling_particles
