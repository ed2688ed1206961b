#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "load_sections.hpp"
#include "model/container.hpp"
#include "model/lattice.hpp"
#include "model/periodic_walls.hpp"

namespace falling_particles {
namespace {

constexpr std::int64_t kMostSegments = 10'000;
constexpr std::int64_t kMostSamples = 4096;

std::array<double, 2> read_width(const TomlTable& table) {
  const std::vector<double> width = table.numbers("width", 2, Interval::positive(kLargestLength, "m"));
  return {width[0], width[1]};
}

Box read_box(const TomlTable& table) {
  table.refuse_unknown_keys({"kind", "width"});
  return {read_width(table)};
}

std::optional<Dish> read_dish(const TomlTable& container, const Hopper& hopper) {
  const auto table = container.find_table("dish", {"diameter", "height", "rim"});
  if (!table) return std::nullopt;
  Dish dish{};
  dish.height = table->number("height", {0, hopper.clearance, false, false, "m (below the outlet)"});
  dish.rim = table->number("rim", {0, hopper.clearance - dish.height, false, false, "m (below the outlet)"});
  const double widest = hopper.tray_width * std::cos(std::numbers::pi / hopper.segments) - 2 * dish.rim_width();
  dish.diameter = table->number("diameter", {0, widest, false, false, "m (with its rim within the tray)"});
  return dish;
}

/// A run from a state may begin with an open outlet. Grains of a lattice need the lid.
double read_opens_at(const TomlTable& table, const Time& time, bool has_state) {
  const char* const note =
      has_state ? "s (before time.duration; 0: open from the start)" : "s (before time.duration; 0 only with [start])";
  return table.number("opens_at", {0, time.duration, has_state, false, note});
}

Hopper read_hopper(const TomlTable& table, const Time& time, bool has_state) {
  table.refuse_unknown_keys(
      {"kind", "outlet", "wall_angle", "diameter", "cylinder_height", "segments", "clearance", "tray_width", "opens_at", "dish"});
  Hopper hopper{};
  hopper.outlet = table.number("outlet", Interval::positive(kLargestLength, "m"));
  hopper.diameter = table.number("diameter", {hopper.outlet, kLargestLength, false, true, "m (above container.outlet)"});
  hopper.wall_angle = table.number("wall_angle", Interval::closed(1, 89, "degrees from the vertical"));
  hopper.cylinder_height = table.number("cylinder_height", Interval::positive(kLargestLength, "m"));
  hopper.segments = static_cast<int>(table.integer("segments", 3, kMostSegments));
  hopper.clearance = table.number("clearance", Interval::positive(kLargestLength, "m"));
  const double outer = hopper.diameter / std::cos(std::numbers::pi / hopper.segments);
  hopper.tray_width =
      table.number("tray_width", Interval::closed(outer, 2 * kLargestLength, "m (the hopper hangs between its walls)"));
  hopper.opens_at = read_opens_at(table, time, has_state);
  hopper.dish = read_dish(table, hopper);
  return hopper;
}

Terrain read_terrain(const TomlTable& table) {
  table.refuse_unknown_keys({"kind", "width", "amplitude", "wavelength", "ridge_height", "samples", "seed"});
  TerrainParameters parameters{};
  parameters.width = read_width(table);
  parameters.amplitude = table.number("amplitude", Interval::closed(0, kLargestLength, "m"));
  parameters.wavelength = table.number("wavelength", Interval::positive(kLargestLength, "m"));
  parameters.ridge_height = table.number("ridge_height", Interval::closed(0, kLargestLength, "m"));
  parameters.samples = static_cast<int>(table.integer("samples", 2, kMostSamples));
  parameters.seed = static_cast<std::uint64_t>(table.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  return Terrain(parameters);
}

Periodic read_periodic(const TomlTable& table) {
  table.refuse_unknown_keys({"kind", "side"});
  return {table.number("side", Interval::positive(kLargestLength, "m"))};
}

Open read_open(const TomlTable& root, const TomlTable& table) {
  table.refuse_unknown_keys({"kind", "start", "bounds"});
  if (!root.has("part"))
    table.fail("kind", "container.kind is \"none\" in a scene without parts; allowed: with one or more [[part]]");
  const auto region = [&table](const char* key) { return read_region(table.table(key, {"corner", "size"})); };
  Open open{region("start"), region("bounds")};
  for (std::size_t i = 0; i < 3; ++i) {
    const double end = open.start.corner[i] + open.start.size[i];
    if (open.start.corner[i] >= open.bounds.corner[i] && end <= open.bounds.corner[i] + open.bounds.size[i]) continue;
    table.fail("start", std::string("container.start reaches from ") + shortest(open.start.corner[i]) + " to " + shortest(end) +
                            " m along " + "xyz"[i] + "; allowed: within container.bounds");
  }
  return open;
}

/// Reads the start (s) of a motion; 0 if it is not given.
double read_start(const TomlTable& table, const char* key, const Time& time) {
  return table.has(key) ? table.number(key, {0, time.duration, true, false, "s (before time.duration)"}) : 0;
}

double read_length(const TomlTable& table, const char* key) { return table.number(key, Interval::positive(kLargestLength, "m")); }

/// Reads a cell without the keys of its sides, which load_walls() reads.
Cell read_cell(const TomlTable& table) {
  table.refuse_unknown_keys({"kind", "corner", "width", "height", "x_low", "x_high", "y_low", "y_high", "z_low", "z_high"});
  Vector3 corner = Vector3::Zero();
  if (table.has("corner")) corner = read_vector(table, "corner", Interval::closed(-kLargestLength, kLargestLength, "m"));
  const std::array<double, 2> width = read_width(table);
  const double height = table.has("height") ? read_length(table, "height") : INFINITY;
  if (std::isinf(height) && table.has("z_high")) {
    table.fail("z_high", "container.z_high in a cell without container.height; allowed: with it");
  }
  constexpr double kFar = kLargestLength;  // m; leaks are found by the planes, and grains without weight fly on
  const auto& [x, y, z] = std::array{corner.x(), corner.y(), corner.z()};
  return {{{{x, y, z}, {width[0], width[1], height}}, {{x - kFar, y - kFar, z - kFar}, {3 * kFar, 3 * kFar, 3 * kFar}}}};
}

Drum read_drum(const TomlTable& table, const Time& time) {
  table.refuse_unknown_keys({"kind", "diameter", "length", "segments", "rpm", "turns_at"});
  Drum drum{};
  drum.diameter = read_length(table, "diameter");
  drum.length = read_length(table, "length");
  drum.segments = static_cast<int>(table.integer("segments", 8, 10'000));
  drum.rpm = read_rpm(table, time);
  drum.turns_at = read_start(table, "turns_at", time);
  return drum;
}

/// The lattice needs space for one cell. A cell holds the largest grain in any orientation.
void check_width(const TomlTable& table, const Scene& scene) {
  const Rectangle plan = plan_of(scene.container);
  const double narrowest = std::min(plan.width[0], plan.width[1]);
  const double cell = scene.smallest_cell();
  if (narrowest >= cell) return;
  const char* key = "width";
  if (std::holds_alternative<Open>(scene.container)) key = "start";
  if (std::holds_alternative<Drum>(scene.container)) key = plan.width[0] < plan.width[1] ? "diameter" : "length";
  table.fail(key, "container." + std::string(key) + " is " + rounded(narrowest, 6) + " at its narrowest; allowed: at least " +
                      rounded_up(cell) + " m, so that the largest grain fits in any orientation");
}

/// Below a ceiling there may be no space for all grains of the start.
void check_ceiling(const TomlTable& table, const Scene& scene) {
  if (std::isinf(ceiling_of(scene.container))) return;
  Lattice lattice(scene);
  int room = 0;
  try {
    for (const GrainCount& entry : scene.kinds) {
      const double radius = entry.kind.bounding_radius();
      for (int i = 0; i < entry.count; ++i, ++room) lattice.next(entry.scale(static_cast<std::size_t>(i)) * radius);
    }
  } catch (const NoRoom&) {
    std::string key = "height";
    if (std::holds_alternative<Drum>(scene.container)) key = "diameter";
    const auto* const open = std::get_if<Open>(&scene.container);
    const double value = open != nullptr ? open->start.size[2] : table.number(key.c_str(), Interval::finite(""));
    table.fail(open != nullptr ? "start" : key.c_str(),
               "container." + (open != nullptr ? "start.size[2]" : key) + " is " + shortest(value) + " m, with room for " +
                   std::to_string(room) + " of the scene's " + counted(static_cast<std::size_t>(scene.grains_at_start()), "grain") +
                   " at the start; allowed: a larger container, or fewer grains");
  }
}

void check_periodic(const TomlTable& table, const Scene& scene, const Periodic& periodic) {
  const double least = 4 * scene.largest_bounding_radius();
  if (periodic.side >= least) return;
  table.fail("side", "container.side is " + shortest(periodic.side) + "; allowed: at least " + rounded_up(least) +
                         " m, so that no grain meets itself");
}

/// One of three by three cells lies within the circle around them. None of two by two cells does.
void check_hopper(const TomlTable& table, const Scene& scene, const Hopper& hopper) {
  const double narrowest = 3 * scene.smallest_cell();
  if (hopper.diameter < narrowest) {
    table.fail("diameter", "container.diameter is " + shortest(hopper.diameter) + "; allowed: at least " + rounded_up(narrowest) +
                               " m, so that the lattice of the grains' starts has a cell in it");
  }
  const double missing = filled_lattice(scene).top() - hopper.top();
  if (missing <= 0) return;
  table.fail("cylinder_height", "container.cylinder_height is " + shortest(hopper.cylinder_height) + "; allowed: at least " +
                                    rounded_up(hopper.cylinder_height + missing) +
                                    " m, so that all grains start within the hopper");
}

constexpr std::array kAxes = {"x", "y"};

std::string in_brackets(const Period& period) { return "[" + shortest(period.lower) + ", " + shortest(period.upper()) + "]"; }

/// The axes along which containers can be periodic.
constexpr const char* kAllowed =
    "allowed: periodic.x and periodic.y in a box or a container of kind \"none\"; periodic.y in a drum";

/// The interval between the container's walls along an axis. Empty if the container cannot be periodic along it. A container
/// without walls may have any period.
std::optional<Period> between_walls(const Container& container, std::size_t axis) {
  const Rectangle plan = plan_of(container);
  const bool is_drum = std::holds_alternative<Drum>(container);
  if (!std::holds_alternative<Box>(container) && !(is_drum && axis == 1)) return std::nullopt;
  return Period{plan.corner[axis], plan.width[axis]};
}

void check_start(const TomlTable& table, const char* key, const Period& period, const Open& open, std::size_t axis) {
  const double from = open.start.corner[axis];
  const double to = from + open.start.size[axis];
  if (from >= period.lower && to <= period.upper()) return;
  table.fail(key, "periodic." + std::string(key) + " is " + in_brackets(period) +
                      "; allowed: around container.start, which is from " + shortest(from) + " to " + shortest(to) + " m");
}

Period read_period(const TomlTable& table, std::size_t axis, const Scene& scene) {
  const char* const key = kAxes[axis];
  const std::vector<double> ends = table.numbers(key, 2, Interval::closed(-kLargestLength, kLargestLength, "m"));
  Period period{ends[0], ends[1] - ends[0]};
  const double least = 4 * scene.largest_bounding_radius();
  if (!(period.length >= least)) {
    table.fail(key, "periodic." + std::string(key) + " is " + in_brackets(period) + "; allowed: the upper end at least " +
                        rounded_up(least) + " m above the lower one, so that no grain meets itself");
  }
  if (const Open* open = std::get_if<Open>(&scene.container)) {
    check_start(table, key, period, *open, axis);
    return period;
  }
  const std::optional<Period> whole = between_walls(scene.container, axis);
  if (!whole) table.fail(key, "periodic." + std::string(key) + " in a " + kind_of(scene.container) + "; " + kAllowed);
  constexpr double kRounding = 1e-9;  // of the length
  const double tolerance = kRounding * whole->length;
  if (std::abs(period.lower - whole->lower) > tolerance || std::abs(period.upper() - whole->upper()) > tolerance) {
    table.fail(key, "periodic." + std::string(key) + " is " + in_brackets(period) + "; allowed: " + in_brackets(*whole) +
                        " m, from wall to wall of the container");
  }
  return *whole;
}

}  // namespace

Container read_container(const TomlTable& root, const Time& time) {
  const TomlTable table = root.table("container");
  const std::string kind = table.choice("kind", {"box", "hopper", "terrain", "periodic", "none", "drum", "cell"});
  if (kind == "hopper") return read_hopper(table, time, root.has("start"));
  if (kind == "terrain") return read_terrain(table);
  if (kind == "periodic") return read_periodic(table);
  if (kind == "cell") return read_cell(table);
  if (kind == "none") return read_open(root, table);
  if (kind == "drum") return read_drum(table, time);
  return read_box(table);
}

void check_fit(const TomlTable& root, const Scene& scene) {
  const TomlTable table = root.table("container");
  if (const Hopper* hopper = std::get_if<Hopper>(&scene.container); hopper != nullptr && !scene.start) {
    check_hopper(table, scene, *hopper);
  } else if (const Periodic* periodic = std::get_if<Periodic>(&scene.container)) {
    check_periodic(table, scene, *periodic);
  } else if (!scene.start) {
    check_width(table, scene);
    check_ceiling(table, scene);
  }
}

void load_periodic(const TomlTable& root, Scene& scene) {
  const auto table = root.find_table("periodic", {"x", "y"});
  if (!table) return;
  if (std::holds_alternative<Periodic>(scene.container)) {
    root.fail("periodic", "[periodic] beside a periodic container, which repeats in all directions; allowed: one of them");
  }
  if (!table->has("x") && !table->has("y")) table->fail("", "[periodic] names no axis; allowed: x = [lower, upper], y, or both");
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (table->has(kAxes[axis])) scene.periodic[axis] = read_period(*table, axis, scene);
  }
  const double reach = 2 * scene.largest_bounding_radius();
  open_container(scene.periodic, reach, walls_in(scene.container).size(), scene.walls);
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (!scene.periodic[axis]) continue;
    for (const Wall& wall : scene.walls) {
      const std::optional<std::string> end = find_end(wall, axis, *scene.periodic[axis], reach);
      if (!end) continue;
      table->fail(kAxes[axis],
                  wall.called() + " is not the same all along " + kAxes[axis] + ", on which the scene repeats: " + *end +
                      "; allowed: planes, boxes, cylinders and prisms through the whole cell that move in the same way "
                      "everywhere along it");
    }
  }
}

}  // namespace falling_particles
