#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <variant>

#include "load_motion.hpp"
#include "load_sections.hpp"

namespace falling_particles {
namespace {

constexpr double kLargestRate = 1e9;  // grains/s and kg/s
constexpr double kMostGrains = 1e6;   // of all feeders and of the start together

/// Reads a name, which must fit into a CSV field.
std::string read_name(const TomlTable& table, std::set<std::string>& names) {
  const std::string name = table.text("name");
  if (name.empty() || name.find_first_not_of(kNameCharacters) != std::string::npos) {
    table.fail("name", table.full_name("name") + " is \"" + name + "\"; allowed: letters, digits, _ and -");
  }
  if (!names.insert(name).second) {
    table.fail("name", table.full_name("name") + " is \"" + name + "\", which another one has; allowed: a name of its own");
  }
  return name;
}

Point to_point(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Reads one of two keys, in grains or in kg.
Quantity read_quantity(const TomlTable& table, const char* grains, const char* kg, const char* unit_of_grains,
                       const char* unit_of_kg) {
  if (table.has(grains) == table.has(kg)) {
    table.fail(table.has(kg) ? kg : "", table.full_name(grains) + " and " + table.full_name(kg) +
                                            (table.has(kg) ? " are both given" : " are missing") + "; allowed: one of them");
  }
  if (table.has(kg)) return {table.number(kg, Interval::positive(kLargestRate, unit_of_kg)), Quantity::Of::Mass};
  return {table.number(grains, Interval::positive(kLargestRate, unit_of_grains)), Quantity::Of::Grains};
}

std::size_t find_kind(const TomlTable& entry, const Scene& scene) {
  std::vector<std::string> names;
  for (const GrainCount& each : scene.kinds) names.push_back(each.kind.name);
  const std::string name = entry.choice("name", names);
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

/// Reads the kinds that the feeder lists. Without a list, the mixture has the scene's kinds in the ratio of their counts.
std::vector<FedKind> read_mixture(const TomlTable& table, const Scene& scene) {
  std::vector<FedKind> mixture;
  if (!table.has("grain")) {
    const int all = scene.grains_at_start();
    if (all == 0 && scene.kinds.size() > 1) {
      table.fail("",
                 "feeder.grain is missing in a scene whose grains all have count = 0; allowed: [[feeder.grain]] with name and "
                 "fraction of each kind");
    }
    for (std::size_t kind = 0; kind < scene.kinds.size(); ++kind) {
      const int count = scene.kinds[kind].count;
      if (count > 0 || all == 0) mixture.push_back({kind, all == 0 ? 1.0 : static_cast<double>(count) / all});
    }
    return mixture;
  }
  double sum = 0;
  const std::vector<TomlTable> entries = table.tables("grain", {"name", "fraction"});
  for (const TomlTable& entry : entries) {
    mixture.push_back({find_kind(entry, scene), entry.number("fraction", Interval::positive(1, ""))});
    sum += mixture.back().fraction;
    if (std::ranges::count(mixture, mixture.back().kind, &FedKind::kind) > 1) {
      entry.fail("name", entry.full_name("name") + " is listed twice; allowed: once, with the sum");
    }
  }
  if (std::abs(sum - 1) > 0.005) {
    entries.front().fail("fraction", "the fractions of feeder.grain sum to " + shortest(sum) + "; allowed: a sum of 1");
  }
  for (FedKind& fed : mixture) fed.fraction /= sum;
  return mixture;
}

/// Refuses a total below the mass of every grain, which would feed nothing.
void check_total(const TomlTable& table, const Feeder& feeder, const Scene& scene) {
  if (!feeder.total) return;
  const double number = feeder.total->number;
  if (feeder.total->of == Quantity::Of::Grains) {
    if (number >= 1 && number == std::floor(number)) return;
    table.fail("total_grains",
               table.full_name("total_grains") + " is " + shortest(number) + "; allowed: a whole number of grains, at least 1");
  }
  const double least = lightest_grain(feeder, scene);
  if (number >= least) return;
  table.fail("total_kg", table.full_name("total_kg") + " is " + shortest(number) + "; allowed: at least " + rounded(least) +
                             " kg, the mass of the lightest grain that it may feed");
}

/// Refuses a region outside the container and every sink. The containers are convex, so the outermost centres suffice.
void check_inside(const TomlTable& table, const Feeder& feeder, const Scene& scene) {
  double least = INFINITY;  // m, distance of a centre from the region's sides
  for (const FedKind& fed : feeder.mixture) {
    const GrainCount& entry = scene.kinds[fed.kind];
    least = std::min(least, entry.smallest_scale() * entry.kind.bounding_radius());
  }
  for (unsigned corner = 0; corner < 8; ++corner) {
    Point centre = feeder.region.corner;
    for (unsigned axis = 0; axis < 3; ++axis) {
      centre[axis] += ((corner >> axis) & 1U) != 0 ? feeder.region.size[axis] - least : least;
    }
    if (is_inside(scene, centre)) continue;
    table.fail("corner", "feeder \"" + feeder.name + "\" would feed grains at [" + shortest(centre[0]) + ", " +
                             shortest(centre[1]) + ", " + shortest(centre[2]) + "] m, which is outside the container (" +
                             kind_of(scene.container) + ") and every sink; allowed: a region within them");
  }
}

/// Refuses a region that is too small for a grain in any orientation.
void check_size(const TomlTable& table, const Feeder& feeder, const Scene& scene) {
  for (const FedKind& fed : feeder.mixture) {
    const GrainCount& entry = scene.kinds[fed.kind];
    const double width = 2 * entry.largest_scale() * entry.kind.bounding_radius();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (feeder.region.size[axis] >= width) continue;
      table.fail("size", table.full_name("size") + "[" + std::to_string(axis) + "] is " + shortest(feeder.region.size[axis]) +
                             "; allowed: at least " + rounded_up(width) + " m, so that grain \"" + entry.kind.name +
                             "\" fits in any orientation");
    }
  }
}

/// Refuses a region that crosses the boundary of a periodic cell.
void check_cell(const TomlTable& table, const Feeder& feeder, const Scene& scene) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<Period>& period = scene.periodic[axis];
    const double from = feeder.region.corner[axis];
    const double to = from + feeder.region.size[axis];
    if (!period || (from >= period->lower && to <= period->upper())) continue;
    table.fail("corner", "feeder \"" + feeder.name + "\" reaches from " + shortest(from) + " to " + shortest(to) + " m along " +
                             "xyz"[axis] + "; allowed: from " + shortest(period->lower) + " to " + shortest(period->upper()) +
                             " m, within the periodic cell");
  }
}

Feeder read_feeder(const TomlTable& table, const Scene& scene, std::set<std::string>& names) {
  Feeder feeder{};
  feeder.name = read_name(table, names);
  feeder.region = read_region(table);
  feeder.mixture = read_mixture(table, scene);
  feeder.fraction_of = Quantity::Of::Grains;
  if (table.has("fractions_of") && table.choice("fractions_of", {"number", "mass"}) == "mass") {
    feeder.fraction_of = Quantity::Of::Mass;
  }
  feeder.rate = read_quantity(table, "grains_per_second", "kg_per_second", "grains/s", "kg/s");
  if (table.has("total_grains") || table.has("total_kg"))
    feeder.total = read_quantity(table, "total_grains", "total_kg", "grains", "kg");
  check_total(table, feeder, scene);
  std::tie(feeder.from, feeder.until) = read_times(table);
  if (table.has("velocity")) {
    feeder.velocity = to_point(read_vector(table, "velocity", Interval::closed(-kLargestSpeed, kLargestSpeed, "m/s")));
  }
  if (table.has("patience")) feeder.patience = table.number("patience", Interval::closed(0, 3600, "s"));
  check_size(table, feeder, scene);
  check_cell(table, feeder, scene);
  check_inside(table, feeder, scene);
  return feeder;
}

Sink read_sink(const TomlTable& table, std::set<std::string>& names) {
  Sink sink{read_name(table, names), {}};
  const bool is_box = table.has("corner") || table.has("size");
  if (is_box == (table.has("point") || table.has("normal"))) {
    table.fail("", table.full_name("corner") + (is_box ? " and " : " or ") + table.full_name("point") +
                       (is_box ? " are both given" : " is missing") +
                       "; allowed: a box (corner, size) or what is below a plane (point, normal)");
  }
  if (is_box) {
    sink.region = read_region(table);
  } else {
    sink.region = HalfSpace{to_point(read_vector(table, "point", Interval::closed(-kLargestLength, kLargestLength, "m"))),
                            to_point(read_direction(table, "normal"))};
  }
  return sink;
}

void refuse_in_packing(const TomlTable& root, const Scene& scene, const char* key) {
  if (std::holds_alternative<Periodic>(scene.container)) {
    root.fail(key, std::string(key) + " in a periodic container; allowed: in any other container");
  }
}

}  // namespace

std::vector<Feeder> load_feeders(const TomlTable& root, const Scene& scene) {
  std::vector<Feeder> feeders;
  if (!root.has("feeder")) return feeders;
  refuse_in_packing(root, scene, "feeder");
  std::set<std::string> names;
  double most = scene.grains_at_start();
  for (const TomlTable& table :
       root.tables("feeder", {"name", "corner", "size", "grain", "fractions_of", "grains_per_second", "kg_per_second",
                              "total_grains", "total_kg", "from", "until", "velocity", "patience"})) {
    feeders.push_back(read_feeder(table, scene, names));
    most += most_grains(feeders.back(), scene);
    if (most > kMostGrains) {
      table.fail("", "feeder \"" + feeders.back().name + "\" brings the scene to " + shortest(std::round(most)) +
                         " grains by its end; allowed: up to " + shortest(kMostGrains));
    }
  }
  return feeders;
}

std::vector<Sink> load_sinks(const TomlTable& root, const Scene& scene) {
  std::vector<Sink> sinks;
  if (!root.has("sink")) return sinks;
  refuse_in_packing(root, scene, "sink");
  std::set<std::string> names;
  for (const TomlTable& table : root.tables("sink", {"name", "corner", "size", "point", "normal"})) {
    sinks.push_back(read_sink(table, names));
  }
  return sinks;
}

}  // namespace falling_particles
