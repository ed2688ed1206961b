#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <utility>

#include "base/toml_input.hpp"
#include "catalogue.hpp"
#include "common/input_error.hpp"
#include "common/nearest_word.hpp"
#include "common/read_file.hpp"
#include "load_sections.hpp"
#include "model/scene.hpp"

namespace falling_particles {
namespace {

constexpr std::int64_t kMostBodies = 1'000'000;
constexpr std::int64_t kMostSteps = 1'000'000'000;

/// Reads the catalogue that the scene names by a path relative to its folder.
std::vector<CatalogueEntry> read_catalogue(const TomlTable& root, const std::string& scene_path) {
  const std::filesystem::path path = std::filesystem::path(scene_path).parent_path() / root.text("catalogue");
  const std::string allowed = "; allowed: a grain catalogue, its path relative to the scene file";
  if (const std::string other = what_is_no_file(path); !other.empty()) {
    root.fail("catalogue", "catalogue: \"" + path.string() + "\" is " + other + allowed);
  }
  if (!std::filesystem::is_regular_file(path)) {
    root.fail("catalogue", "catalogue: there is no file \"" + path.string() + "\"" + allowed);
  }
  return open_catalogue(path.string());
}

const CatalogueEntry& find_grain(const std::vector<CatalogueEntry>& catalogue, const TomlTable& entry) {
  const std::string name = entry.text("name");
  const auto found = std::ranges::find(catalogue, name, &CatalogueEntry::name);
  if (found != catalogue.end()) return *found;
  std::vector<std::string> names;
  names.reserve(catalogue.size());
  for (const CatalogueEntry& grain : catalogue) names.push_back(grain.name);
  entry.fail("name", "unknown grain \"" + name + "\"" + did_you_mean(name, names) + "; allowed (the catalogue's): " + join(names));
}

/// Whole numbers in the ratio of `fractions` that sum to `total`: all are rounded down, then those with the largest remainders up.
std::vector<int> apportion(const std::vector<double>& fractions, int total) {
  std::vector<int> counts;
  std::vector<std::pair<double, std::size_t>> remainders;
  int given = 0;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    const double exact = fractions[i] * total;
    counts.push_back(static_cast<int>(exact));
    remainders.emplace_back(static_cast<double>(counts.back()) - exact, i);
    given += counts.back();
  }
  std::ranges::sort(remainders);
  for (std::size_t k = 0; given < total; ++k, ++given) ++counts[remainders[k % remainders.size()].second];
  return counts;
}

std::vector<int> read_fractions(const std::vector<TomlTable>& entries, const TomlTable& drop) {
  if (!drop.has("total")) drop.fail("total", "drop.total is missing; needed where grains are given by fraction");
  const int total = static_cast<int>(drop.integer("total", 1, kMostBodies));
  std::vector<double> fractions;
  double sum = 0;
  for (const TomlTable& entry : entries) {
    fractions.push_back(entry.number("fraction", Interval::positive(1, "")));
    sum += fractions.back();
  }
  // Typed fractions may be rounded: three times 0.333 counts as 1.
  if (std::abs(sum - 1) > 0.005) {
    entries.front().fail("fraction", "the fractions of the grains sum to " + shortest(sum) + "; allowed: a sum of 1");
  }
  for (double& fraction : fractions) fraction /= sum;
  return apportion(fractions, total);
}

/// `least`: the least allowed count; 0 if there are feeders.
std::vector<int> read_counts(const std::vector<TomlTable>& entries, const TomlTable& drop, int least) {
  if (drop.has("total")) drop.fail("total", "drop.total is given besides counts; allowed: with fractions only");
  std::vector<int> counts;
  counts.reserve(entries.size());
  for (const TomlTable& entry : entries) counts.push_back(static_cast<int>(entry.integer("count", least, kMostBodies)));
  return counts;
}

void refuse_too_many(const TomlTable& root, std::int64_t grains) {
  if (grains <= kMostBodies) return;
  root.fail("grain", "the scene has " + counted(static_cast<std::size_t>(grains), "grain") + "; allowed: up to " +
                         std::to_string(kMostBodies));
}

/// The kinds of a scene, none of which has grains yet.
std::vector<GrainCount> read_kinds(const TomlTable& root, const std::vector<TomlTable>& entries, const std::string& scene_path) {
  const std::vector<CatalogueEntry> catalogue = read_catalogue(root, scene_path);
  const bool by_fraction = entries.front().has("fraction");
  std::vector<GrainCount> kinds;
  std::set<std::string> seen;
  for (const TomlTable& entry : entries) {
    const CatalogueEntry& found = find_grain(catalogue, entry);
    if (!seen.insert(found.name).second) {
      entry.fail("name", "grain \"" + found.name + "\" is listed twice; allowed: once, with the sum");
    }
    GrainCount& kind = kinds.emplace_back(GrainCount{found.make(), 0});
    kind.size = load_sizes(entry, kind.kind.sieve_size());
    kind.is_fed = root.has("feeder");
    const char* other = by_fraction ? "count" : "fraction";
    if (entry.has(other)) {
      entry.refuse(other, std::string(" is mixed with ") + (by_fraction ? "fraction" : "count") +
                              "; allowed: count for all grains or fraction for all grains");
    }
  }
  return kinds;
}

/// Gives the kinds their grains, with drawn sizes.
void count_grains(const TomlTable& root, const std::vector<TomlTable>& entries, const TomlTable& drop, Scene& scene) {
  const std::vector<int> counts =
      entries.front().has("fraction") ? read_fractions(entries, drop) : read_counts(entries, drop, root.has("feeder") ? 0 : 1);
  std::int64_t sum = 0;
  for (const int count : counts) sum += count;
  refuse_too_many(root, sum);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    GrainCount& entry = scene.kinds[i];
    entry.count = counts[i];
    if (entry.size) entry.scales = draw_sizes(*entry.size, entry.count, seed_of_sizes(scene.seed, i));
  }
}

/// Gives the kinds the grains of the state. Counts and fractions of the scene have no effect.
void count_state(const TomlTable& root, const std::vector<TomlTable>& entries, Scene& scene) {
  for (const TomlTable& entry : entries) {
    if (entry.has("count")) entry.integer("count", 0, kMostBodies);
    if (entry.has("fraction")) entry.number("fraction", Interval::positive(1, ""));
  }
  refuse_too_many(root, static_cast<std::int64_t>(scene.start->grains.size()));
  for (const StartGrain& grain : scene.start->grains) {
    GrainCount& entry = scene.kinds[grain.kind];
    ++entry.count;
    if (entry.size) entry.scales.push_back(grain.scale);
  }
}

void read_grains(const TomlTable& root, const TomlTable& drop, const std::string& scene_path, Scene& scene) {
  const std::vector<TomlTable> entries = root.tables("grain", {"name", "count", "fraction", "size"});
  scene.kinds = read_kinds(root, entries, scene_path);
  scene.start = load_start(root, scene.kinds, scene_path);
  scene.start ? count_state(root, entries, scene) : count_grains(root, entries, drop, scene);
}

/// The most grains that a scene may have at once. With sinks only the grains of the start count, because the effect of sinks is not
/// known in advance.
int most_at_once(const Scene& scene) {
  return static_cast<int>(scene.grains_at_start() + (scene.sinks.empty() ? most_fed(scene) : 0));
}

void check_memory(const TomlTable& root, int grains) {
  constexpr double kGigabyte = 1e9;
  const double needed = memory_needed(grains);
  const double available = memory_of_machine();
  if (needed <= available) return;
  const auto in_gigabytes = [](double bytes) { return shortest(std::round(bytes / kGigabyte * 10) / 10) + " GB"; };
  root.fail("grain", "the scene has " + counted(static_cast<std::size_t>(grains), "grain") + ", a bed of which takes " +
                         in_gigabytes(needed) + " of memory; allowed with " + in_gigabytes(available) + ": up to " +
                         counted(static_cast<std::size_t>(most_grains(available)), "grain"));
}

Time read_time(const TomlTable& table) {
  Time time{};
  time.duration = table.number("duration", Interval::positive(3600, "s"));
  time.step = table.number("step", Interval::positive(time.duration, "s (up to time.duration)"));
  time.frame = table.number("frame", Interval::closed(time.step, time.duration, "s (from time.step to time.duration)"));
  if (time.duration / time.step > static_cast<double>(kMostSteps)) {
    table.fail("step", "time.duration / time.step is above " + std::to_string(kMostSteps) + " steps; allowed: a larger step");
  }
  return time;
}

/// Reads [drop] into the scene and returns the table that may have `total`. Grains in a periodic container do not drop. A scene
/// with feeders or a state may lack the section.
TomlTable read_drop(const TomlTable& root, Scene& scene) {
  if ((root.has("feeder") || root.has("start")) && !root.has("drop")) return root;
  if (std::holds_alternative<Periodic>(scene.container)) {
    if (root.has("drop")) return root.table("drop", {"total"});
    return root;
  }
  const TomlTable drop = root.table("drop", {"height", "gap", "total"});
  scene.drop = {drop.number("height", Interval::closed(0, 1000, "m")), drop.number("gap", Interval::closed(0, 10, ""))};
  return drop;
}

std::optional<Compression> read_compression(const TomlTable& root, const Scene& scene) {
  const auto table = root.find_table("compression", {"overlap", "final_overlap", "damping"});
  if (!table) return std::nullopt;
  if (scene.looks_ahead()) {
    root.fail("speculative_contacts",
              "speculative_contacts in a compression, which works by the overlaps that they prevent; allowed: one of both");
  }
  if (!std::holds_alternative<Periodic>(scene.container)) {
    root.fail("compression", std::string("compression in a ") + kind_of(scene.container) + "; allowed: in a periodic container");
  }
  Compression compression{};
  compression.overlap = table->number("overlap", Interval::positive(0.1, "(relative to the distance of two grains)"));
  compression.final_overlap =
      table->number("final_overlap", Interval::positive(compression.overlap, "(up to compression.overlap)"));
  compression.damping = table->number("damping", Interval::closed(0, 1, "(of the velocities, a step)"));
  return compression;
}

std::optional<Query> read_query(const TomlTable& root) {
  const auto table = root.find_table("query", {"solver", "tolerance", "max_evaluations", "warm_start"});
  if (!table) return std::nullopt;
  Query query;
  if (table->has("solver")) {
    const std::string word =
        table->choice("solver", {name_of(SN_SOLVER_HYBRID), name_of(SN_SOLVER_NEWTON), name_of(SN_SOLVER_FIXED_POINT)});
    for (const snSolver solver : {SN_SOLVER_NEWTON, SN_SOLVER_FIXED_POINT}) {
      if (word == name_of(solver)) query.solver = solver;
    }
  }
  if (table->has("tolerance")) query.tolerance = table->number("tolerance", Interval::closed(1e-15, 1, ""));
  if (table->has("max_evaluations")) query.max_evaluations = static_cast<int>(table->integer("max_evaluations", 1, 1000000));
  if (table->has("warm_start")) query.warm_start = table->boolean("warm_start");
  return query;
}

void read_output(const TomlTable& root, Scene& scene) {
  scene.pictures = default_pictures();
  const auto table = root.find_table("output", {"pictures", "forces"});
  if (!table) return;
  if (table->has("forces")) scene.forces = table->boolean("forces");
  if (!table->has("pictures")) return;
  const std::vector<std::string> names(kPictureNames.begin(), kPictureNames.end());
  scene.pictures = table->choices("pictures", names);
}

/// The files that the scene names relative to its folder. All have been read before.
std::vector<std::filesystem::path> files_of(const TomlTable& root, const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files = {path.parent_path() / root.text("catalogue")};
  if (root.has("start")) {
    const TomlTable start = root.table("start");
    files.push_back(path.parent_path() / start.text("file"));
    if (const std::optional<std::string> parts = start.find_text("parts")) files.push_back(path.parent_path() / *parts);
  }
  for (const char* section : {"part", "bond"}) {
    if (!root.has(section)) continue;
    for (const TomlTable& table : root.tables(section)) {
      if (const std::optional<std::string> file = table.find_text("file")) files.push_back(path.parent_path() / *file);
    }
  }
  return files;
}

/// The names of the sections at the top level of the file.
std::vector<std::string> sections() {
  std::vector<std::string> names = {"seed",   "catalogue",   "container", "drop",  "grain",       "time",
                                    "solver", "compression", "output",    "part",  "measurement", "feeder",
                                    "sink",   "periodic",    "query",     "start", "bond"};
  for (std::string& name : effect_sections()) names.push_back(std::move(name));
  return names;
}

/// Names all missing keys that every scene has, if several are missing. One alone is named where it is read, with its range.
void refuse_missing(const TomlTable& root) {
  std::vector<std::string> missing;
  for (const char* key : {"seed", "catalogue", "time", "container", "grain", "solver"}) {
    if (!root.has(key)) missing.emplace_back(key);
  }
  if (missing.size() > 1)
    root.fail("", join(missing) + " are missing; every scene has them, and samples/scenes/short.toml is a small one");
}

Scene load(const TomlFile& file, const std::string& path, const std::string& called, const std::vector<std::string>& overrides) {
  const TomlTable root = file.root(sections());
  refuse_missing(root);
  Scene scene{};
  scene.name = std::filesystem::path(path).stem().string();
  scene.path = path;
  scene.called = called;
  scene.overrides = overrides;
  scene.seed = static_cast<std::uint64_t>(root.integer("seed", 0, std::numeric_limits<std::int64_t>::max()));
  scene.time = read_time(root.table("time", {"duration", "step", "frame"}));
  scene.container = read_container(root, scene.time);
  scene.walls = load_walls(root, scene, path);
  place_walls(root, path, scene.walls);
  const TomlTable drop = read_drop(root, scene);
  read_grains(root, drop, path, scene);
  if (root.has("feeder") && !scene.start && scene.grains_at_start() > 0) root.table("drop");  // reports that it is missing
  load_periodic(root, scene);
  load_servos(root, scene);
  load_bonds(root, path, scene);
  scene.solver = load_solver(root);
  refuse_for_stepper(root, scene);
  scene.effects = load_effects(root, scene.smallest_half_axis(), scene.time.step, scene.solver.solves_contacts());
  load_wall_effects(root, scene);
  scene.compression = read_compression(root, scene);
  scene.sinks = load_sinks(root, scene);
  scene.feeders = load_feeders(root, scene);
  scene.measurements = load_measurements(root, scene);
  scene.query = read_query(root);
  read_output(root, scene);
  check_memory(root, most_at_once(scene));
  check_fit(root, scene);
  scene.files = files_of(root, path);
  return scene;
}

}  // namespace

Scene load_scene(const std::string& path, const std::vector<std::string>& overrides) {
  Scene scene = load(TomlFile(path, "scene file", overrides), path, path, overrides);
  scene.files.insert(scene.files.begin(), path);
  return scene;
}

Scene load_scene_text(const std::string& content, const std::string& path, const std::vector<std::string>& overrides) {
  return load(TomlFile(TomlFile::Text{content}, overrides), path, std::string(InputError::kText), overrides);
}

}  // namespace falling_particles
