#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "load_sections.hpp"
#include "world/grain.hpp"

namespace falling_particles {
namespace {

constexpr double kLargestRate = 1e9;  // grains/s and kg/s
constexpr double kMostGrains = 1e6;   // of all feeders and of the start together

/// Reads a name, which must fit into a CSV field.
std::string read_name(const TomlTable& table, std::set<std::string>& names) {
  const std::string name = table.text("name");
  if (name.empty() || name.find_first_not_of(kNameCharacters) != std::string::npos) {
    table.refuse("name", " is \"" + name + "\"; allowed: letters, digits, _ and -");
  }
  if (!names.insert(name).second) {
    table.refuse("name", " is \"" + name + "\", which another one has; allowed: a name of its own");
  }
  return name;
}

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
      entry.refuse("name", " is listed twice; allowed: once, with the sum");
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
    table.refuse("total_grains", " is " + shortest(number) + "; allowed: a whole number of grains, at least 1");
  }
  const double least = lightest_grain(feeder, scene);
  if (number >= least) return;
  table.refuse("total_kg", " is " + shortest(number) + "; allowed: at least " + rounded(least) +
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
      table.refuse("size", "[" + std::to_string(axis) + "] is " + shortest(feeder.region.size[axis]) + "; allowed: at least " +
                               rounded_up(width) + " m, so that grain \"" + entry.kind.name + "\" fits in any orientation");
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

using By = SizeDistribution::By;

// No grain is larger, as for the half-axes of a catalogue.
constexpr double kLargestSize = 2;  // m
// Relative to the catalogue's size. Beyond it the grain is of another kind.
constexpr double kLargestFactor = 100;
// In a wider distribution the largest cells of the lattice hold few large grains among dust.
constexpr double kLargestRatio = 1000;
constexpr std::int64_t kMostOpenings = 200;

std::vector<std::string> keys_of_sizes(const std::string& distribution) {
  std::vector<std::string> keys = {"distribution", "by", "unit"};
  const auto add = [&keys](std::initializer_list<const char*> more) { keys.insert(keys.end(), more.begin(), more.end()); };
  if (distribution == "sieve") add({"openings", "passing"});
  if (distribution != "sieve") add({"smallest", "largest"});
  if (distribution == "normal") add({"mean", "deviation"});
  if (distribution == "lognormal") add({"median", "geometric_deviation"});
  return keys;
}

/// Reads the lengths of a size, in m or relative to the catalogue's size, as factors on the catalogue's size.
class Lengths {
 public:
  Lengths(const TomlTable& table, double sieve_size)
      : table_(table),
        is_relative_(table.has("unit") && table.choice("unit", {"m", "catalogue"}) == "catalogue"),
        unit_(is_relative_ ? 1 : sieve_size) {}

  double read(const char* key) const { return table_.number(key, range()) / unit_; }

  SizeDistribution::Bounds bounds() const {
    const double smallest = table_.number("smallest", range());
    const Interval above{smallest, smallest * kLargestRatio, false, true,
                         is_relative_ ? "(above size.smallest)" : "m (above size.smallest)"};
    return {smallest / unit_, table_.number("largest", above) / unit_};
  }

  std::vector<double> openings() const {
    std::vector<double> openings = table_.numbers("openings", count("openings"), range());
    for (std::size_t i = 1; i < openings.size(); ++i) {
      if (openings[i] <= openings[i - 1] || openings[i] > kLargestRatio * openings[0]) {
        table_.refuse("openings", "[" + std::to_string(i) + "] is " + shortest(openings[i]) + "; allowed: above the one before, " +
                                      shortest(openings[i - 1]) + ", up to " + shortest(kLargestRatio) + " times the first");
      }
    }
    for (double& opening : openings) opening /= unit_;
    return openings;
  }

  std::vector<double> passing() const {
    std::vector<double> passing = table_.numbers("passing", count("openings"), Interval::closed(0, 1, "(a share)"));
    const auto fail = [this, &passing](std::size_t i, const std::string& allowed) {
      table_.refuse("passing", "[" + std::to_string(i) + "] is " + shortest(passing[i]) + "; allowed: " + allowed);
    };
    if (passing.front() != 0) fail(0, "0, of the sieve that nothing passes");
    if (passing.back() != 1) fail(passing.size() - 1, "1, of the sieve that everything passes");
    for (std::size_t i = 1; i < passing.size(); ++i) {
      if (passing[i] < passing[i - 1]) fail(i, "no less than the one before, " + shortest(passing[i - 1]));
    }
    return passing;
  }

 private:
  Interval range() const {
    return is_relative_ ? Interval::positive(kLargestFactor, "(times the catalogue's size)")
                        : Interval::positive(kLargestSize, "m");
  }

  std::size_t count(const char* key) const {
    const std::size_t count = table_.array_size(key);
    if (count >= 2 && count <= static_cast<std::size_t>(kMostOpenings)) return count;
    table_.refuse(key, " has " + std::to_string(count) + " numbers; allowed: 2 to " + std::to_string(kMostOpenings));
  }

  const TomlTable& table_;
  bool is_relative_;
  double unit_;
};

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

std::optional<SizeDistribution> load_sizes(const TomlTable& entry, double sieve_size) {
  if (!entry.has("size")) return std::nullopt;
  const TomlTable table = entry.table("size");
  const std::string kind = table.choice("distribution", {"uniform", "normal", "lognormal", "sieve"});
  table.refuse_unknown_keys(keys_of_sizes(kind));
  const bool is_sieve = kind == "sieve";
  const By by = (table.has("by") ? table.choice("by", {"number", "mass"}) == "mass" : is_sieve) ? By::Mass : By::Number;
  const Lengths lengths(table, sieve_size);
  if (is_sieve) return SizeDistribution::sieve(lengths.openings(), lengths.passing(), by);
  const SizeDistribution::Bounds bounds = lengths.bounds();
  if (kind == "uniform") return SizeDistribution::uniform(bounds, by);
  if (kind == "normal") return SizeDistribution::normal(lengths.read("mean"), lengths.read("deviation"), bounds, by);
  constexpr double kLargestSpread = 100;
  const double spread = table.number("geometric_deviation", Interval{1, kLargestSpread, false, true, "(a factor)"});
  return SizeDistribution::lognormal(lengths.read("median"), spread, bounds, by);
}

}  // namespace falling_particles
