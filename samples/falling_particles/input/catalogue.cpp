#include "catalogue.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <supernormal/shapes/superovoid.hpp>

#include "base/toml_input.hpp"
#include "model/grain_shape.hpp"

namespace falling_particles {
namespace {

// No grain is larger than this. The usual mistake is millimetres typed as metres.
constexpr double kLargestHalfAxis = 1;  // m
// Osmium is the densest solid: 22 590 kg/m^3.
constexpr double kLargestDensity = 23000;  // kg/m^3

using Shape = ConvexBody::Shape;

Shape shape_in(const TomlTable& table) {
  if (table.has("taper")) return Shape::Superovoid;
  return table.has("shape") && table.choice("shape", {"superellipsoid", "capsule"}) == "capsule" ? Shape::Capsule
                                                                                                 : Shape::Superellipsoid;
}

std::vector<std::string> keys_of(Shape shape) {
  if (shape == Shape::Capsule) return {"shape", "radius", "length"};
  std::vector<std::string> keys = {"half_axes", "delta", "epsilon", "rounding", "taper"};
  if (shape == Shape::Superellipsoid) keys.emplace_back("shape");
  return keys;
}

ConvexBody read_capsule(const TomlTable& table) {
  const double radius = table.number("radius", Interval::positive(kLargestHalfAxis, "m"));
  const double length = table.number("length", Interval::closed(0, 2 * kLargestHalfAxis, "m (of the cylinder between the caps)"));
  return {{radius, radius, radius + length / 2}, 2, 2, 0, Shape::Capsule};
}

/// The library's core checks the taper, whose range depends on the exponents.
void read_taper(const TomlTable& table, ConvexBody& body) {
  const std::vector<double> taper = table.numbers("taper", 2, Interval::closed(-1, 1, "(so small that the body is convex)"));
  body.taper = {taper[0], taper[1]};
  const auto [a, b, c] = body.core_half_axes();
  try {
    const supernormal::Superovoid checked({a, b, c}, body.delta, body.epsilon, taper[0], taper[1]);
  } catch (const std::invalid_argument& refusal) {
    table.refuse("taper", std::string(": ") + refusal.what());
  }
}

/// Reads a convex body. If `needs_exponents` is false, as for a component of a compound, missing exponents are 2 and 2.
ConvexBody read_body(const TomlTable& table, bool needs_exponents) {
  const Shape shape = shape_in(table);
  if (shape == Shape::Capsule) return read_capsule(table);
  // The range of snCreateSuperellipsoid.
  const Interval exponents = Interval::closed(1.01, 1000, "");
  ConvexBody body{{}, 2, 2, 0, shape};
  const std::vector<double> axes = table.numbers("half_axes", 3, Interval::positive(kLargestHalfAxis, "m"));
  body.half_axes = {axes[0], axes[1], axes[2]};
  if (needs_exponents || table.has("delta")) body.delta = table.number("delta", exponents);
  if (needs_exponents || table.has("epsilon")) body.epsilon = table.number("epsilon", exponents);
  if (table.has("rounding")) {
    const double below = body.smallest_half_axis();
    body.rounding = table.number("rounding", Interval{0, below, true, false, "m (below the smallest half-axis)"});
  }
  if (shape == Shape::Superovoid) read_taper(table, body);
  return body;
}

double read_density(const TomlTable& table) { return table.number("density", Interval::positive(kLargestDensity, "kg/m^3")); }

/// The quaternion (w, x, y, z) of a rotation by `angle` (degrees) about `axis`; the identity without them.
std::array<double, 4> read_orientation(const TomlTable& table) {
  if (!table.has("axis") && !table.has("angle")) return {1, 0, 0, 0};
  const std::vector<double> axis = table.numbers("axis", 3, Interval::closed(-1e6, 1e6, "(of any length but 0)"));
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  if (length == 0) table.refuse("axis", " is [0, 0, 0]; allowed: a direction, of any length but 0");
  const double half = table.number("angle", Interval::closed(-360, 360, "degrees")) * std::numbers::pi / 360;
  const double s = std::sin(half) / length;
  return {std::cos(half), s * axis[0], s * axis[1], s * axis[2]};
}

CatalogueEntry compound_entry(const std::string& name, const std::vector<Component>& components, const std::string& source) {
  return {name, [=] { return make_compound(name, components, source); }};
}

CatalogueEntry read_compound(const TomlTable& table, const std::string& name) {
  table.refuse_unknown_keys({"parts", "density", "source"});
  const std::vector<TomlTable> tables = table.tables("parts");
  constexpr std::size_t kMostComponents = 100;
  if (tables.size() > kMostComponents) {
    table.refuse("parts", " has " + std::to_string(tables.size()) + " parts; allowed: up to " + std::to_string(kMostComponents));
  }
  std::vector<Component> components;
  components.reserve(tables.size());
  for (const TomlTable& component : tables) {
    std::vector<std::string> keys = keys_of(shape_in(component));
    keys.insert(keys.end(), {"density", "position", "axis", "angle"});
    component.refuse_unknown_keys(keys);
    Component& read = components.emplace_back(Component{read_body(component, false), 0});
    read.density = read_density(component.has("density") ? component : table);
    if (component.has("position")) {
      const std::vector<double> position =
          component.numbers("position", 3, Interval::closed(-kLargestHalfAxis, kLargestHalfAxis, "m"));
      read.position = {position[0], position[1], position[2]};
    }
    read.quaternion = read_orientation(component);
  }
  return compound_entry(name, components, table.text("source"));
}

CatalogueEntry read_grain(const TomlTable& table, const std::string& name) {
  if (table.has("parts")) return read_compound(table, name);
  const Shape shape = shape_in(table);
  std::vector<std::string> keys = keys_of(shape);
  keys.insert(keys.end(), {"density", "source", "parts"});
  table.refuse_unknown_keys(keys);
  const ConvexBody body = read_body(table, true);
  const double density = read_density(table);
  const std::string source = table.text("source");
  // A superovoid becomes a compound, because its centre of mass is not the origin of its frame.
  if (shape == Shape::Superovoid) return compound_entry(name, {{body, density}}, source);
  const GrainKind kind{name, body.half_axes, body.delta, body.epsilon, body.rounding, density, source, shape == Shape::Capsule};
  return {name, [kind] { return kind; }};
}

}  // namespace

std::vector<CatalogueEntry> open_catalogue(const std::string& path) {
  const TomlTable root = TomlFile(path, "grain catalogue").root();
  std::vector<CatalogueEntry> entries;
  for (const std::string& name : root.names()) {
    // Names are written into CSV files without quotes.
    if (name.find_first_not_of(kNameCharacters) != std::string::npos) {
      root.fail(name, "grain name \"" + name + "\"; allowed: letters, digits, _ and -");
    }
    entries.push_back(read_grain(root.table(name), name));
  }
  return entries;
}

}  // namespace falling_particles
