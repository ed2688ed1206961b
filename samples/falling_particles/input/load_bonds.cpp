#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/nearest_word.hpp"
#include "load_sections.hpp"
#include "state_table.hpp"

namespace falling_particles {
namespace {

constexpr double kLargestModulus = 1e15;  // Pa
constexpr std::size_t kMostNumber = 1'000'000'000'000;
constexpr double kNormError = 1e-3;  // of a quaternion, as in a state

const std::vector<std::string> kBondKeys = {"name",
                                            "kind",
                                            "touching",
                                            "chain",
                                            "file",
                                            "part",
                                            "modulus",
                                            "poisson_ratio",
                                            "radius",
                                            "relative_radius",
                                            "tensile_strength",
                                            "shear_strength",
                                            "damping",
                                            "contacts"};
const std::vector<std::string> kRestColumns = {"start_x_m", "start_y_m", "start_z_m", "x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};

/// The pairs that are bonded so far, with the numbers of their file.
using Taken = std::set<std::pair<std::string, std::size_t>>;

/// Reads the pairs of grains that a section names.
class PairReader {
 public:
  PairReader(const TomlTable& section, const Scene& scene, const BondRule& rule, Taken& taken)
      : section_(section), scene_(scene), rule_(rule), taken_(taken) {
    if (!scene.start) return;
    for (std::size_t i = 0; i < scene.start->grains.size(); ++i) indices_[scene.start->grains[i].number] = i;
  }

  std::vector<BondedPair> read_chain() const {
    if (rule_.wall) section_.fail("chain", "bond.chain beside bond.part; allowed: bond.touching or bond.file with it");
    const std::vector<double> ends =
        section_.numbers("chain", 2, Interval::closed(0, static_cast<double>(kMostNumber), "(the numbers of two grains)"));
    if (std::floor(ends[0]) != ends[0] || std::floor(ends[1]) != ends[1] || !(ends[0] < ends[1])) {
      section_.fail("chain", "bond.chain is [" + shortest(ends[0]) + ", " + shortest(ends[1]) +
                                 "]; allowed: the whole numbers of two grains, the smaller one first");
    }
    const auto fail = [this](const std::string& text) { section_.fail("chain", "bond.chain: " + text); };
    std::vector<BondedPair> pairs;
    for (auto number = static_cast<std::size_t>(ends[0]); number < static_cast<std::size_t>(ends[1]); ++number) {
      pairs.push_back(pair_of(number, number + 1, fail));
    }
    return pairs;
  }

  std::vector<BondedPair> read_file(const std::filesystem::path& path) const {
    const StateTable table(path);
    if (table.is_dump()) table.fail(1, "a dump has no bonds; allowed: final_bonds.csv of a run, or another CSV file");
    std::vector<std::string> known = {"time_s", "bond", "body_1", "body_2", "radius_m"};
    known.insert(known.end(), kRestColumns.begin(), kRestColumns.end());
    table.refuse_others(known);
    table.require({"body_1", "body_2"});
    const bool has_rest = std::ranges::any_of(kRestColumns, [&](const std::string& column) { return table.has(column); });
    if (has_rest) table.require(kRestColumns);
    std::vector<BondedPair> pairs;
    for (const StateTable::Row& row : table.rows()) {
      if (table.has("bond") && table.word(row, "bond") != rule_.name) continue;
      pairs.push_back(read_pair(table, row));
      pairs.back().line = row.line;
      if (table.has("radius_m")) pairs.back().radius = table.number(row, "radius_m", Interval::positive(kLargestLength, "m"));
      if (has_rest) pairs.back().rest = read_rest(table, row);
    }
    if (pairs.empty()) {
      table.fail(1, "no line has \"" + rule_.name +
                        "\" in its column bond; allowed: the name of the section [[bond]]; if all its bonds are broken, leave the "
                        "section out");
    }
    return pairs;
  }

 private:
  std::size_t index_of(std::size_t number, const auto& fail) const {
    const auto found = indices_.find(number);
    if (found == indices_.end()) {
      const auto [least, most] = std::ranges::minmax(scene_.start->grains, {}, &StartGrain::number);
      fail("grain " + std::to_string(number) + " is not in start.file; allowed: its numbers, from " + std::to_string(least.number) +
           " to " + std::to_string(most.number));
    }
    return found->second;
  }

  /// `fail` throws the error.
  BondedPair pair_of(std::size_t first, std::size_t second, const auto& fail) const {
    if (first == second) fail("grain " + std::to_string(first) + " is bonded to itself; allowed: two grains");
    const BondedPair pair{index_of(first, fail), index_of(second, fail)};
    take("grain " + std::to_string(std::min(first, second)), std::max(first, second), fail);
    const Point a = scene_.start->grains[pair.first].position;
    const Point b = scene_.start->grains[pair.second].position;
    if (a == b) {
      fail("the length from grain " + std::to_string(first) + " to grain " + std::to_string(second) +
           " is 0 m; allowed: above 0, between two centres");
    }
    return pair;
  }

  void take(const std::string& first, std::size_t second, const auto& fail) const {
    if (taken_.emplace(first, second).second) return;
    fail(first + " and grain " + std::to_string(second) + " have two bonds; allowed: one");
  }

  BondedPair read_pair(const StateTable& table, const StateTable::Row& row) const {
    const auto fail = [&](const std::string& text) { table.fail(row.line, text); };
    const std::size_t second = table.whole_number(row, "body_2", 0, kMostNumber);
    if (!rule_.wall) return pair_of(table.whole_number(row, "body_1", 0, kMostNumber), second, fail);
    const std::string& part = scene_.walls[*rule_.wall].name;
    if (table.word(row, "body_1") != part) {
      fail("body_1 is \"" + std::string(table.word(row, "body_1")) + "\"; allowed: \"" + part + "\", bond.part of the section");
    }
    const BondedPair pair{0, index_of(second, fail)};
    take("part " + part, second, fail);
    return pair;
  }

  static BondRest read_rest(const StateTable& table, const StateTable::Row& row) {
    std::array<double, 10> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool is_length = i < 6;
      values[i] = table.number(row, kRestColumns[i],
                               is_length ? Interval::closed(-kLargestLength, kLargestLength, "m") : Interval::closed(-2, 2, ""));
    }
    BondRest rest{
        {values[0], values[1], values[2]}, {values[3], values[4], values[5]}, {values[6], values[7], values[8], values[9]}};
    if (!(rest.length() > 0)) table.fail(row.line, "the length of the bond is 0 m; allowed: above 0, from start to x_m, y_m, z_m");
    if (std::abs(rest.rotation.norm() - 1) > kNormError) {
      table.fail(row.line, "qw, qx, qy, qz are a quaternion of norm " + rounded(rest.rotation.norm()) + "; allowed: 1, to " +
                               rounded(kNormError));
    }
    rest.rotation.normalize();
    return rest;
  }

  const TomlTable& section_;
  const Scene& scene_;
  const BondRule& rule_;
  Taken& taken_;
  std::unordered_map<std::size_t, std::size_t> indices_;  // of the grains, by their numbers
};

/// The index of a part that grains can be bonded to.
std::size_t read_part(const TomlTable& section, const Scene& scene) {
  const std::string name = section.text("part");
  const std::vector<std::string> names = names_of(scene.parts());
  const auto found = std::ranges::find_if(scene.walls, [&](const Wall& wall) { return wall.is_part() && wall.name == name; });
  if (found == scene.walls.end()) {
    section.fail("part", "bond.part is \"" + name + "\"" + did_you_mean(name, names) + "; allowed: a part of the scene" +
                             (names.empty() ? ", which has none" : ": " + join(names)));
  }
  if (found->drive || found->flight) {
    section.fail("part", "bond.part is \"" + name + "\", which " + (found->drive ? "a force drives" : "is free") +
                             "; allowed: a part that stands or has motions");
  }
  return static_cast<std::size_t>(found - scene.walls.begin());
}

void read_pairs(const TomlTable& section, const Scene& scene, const std::string& scene_path, BondRule& rule, Taken& taken) {
  std::vector<std::string> sources;
  for (const char* key : {"touching", "chain", "file"}) {
    if (section.has(key)) sources.emplace_back(key);
  }
  if (section.has("file")) sources = {"file"};  // the others may stay in the scene, as [drop] may beside [start]
  if (sources.size() != 1) {
    section.fail(sources.empty() ? "" : sources[1], "bond \"" + rule.name + "\" has " +
                                                        (sources.empty() ? "no pairs" : "both touching and chain") +
                                                        "; allowed: one of touching, chain and file");
  }
  if (sources[0] == "touching") {
    rule.touching = section.number("touching", Interval::closed(0, 10, "(of the smallest half-axis)"));
    return;
  }
  if (!scene.start) {
    section.fail(sources[0], "bond." + sources[0] + " without [start]; allowed: with it, since [drop] shuffles the grains");
  }
  const PairReader reader(section, scene, rule, taken);
  if (sources[0] == "chain") {
    rule.pairs = reader.read_chain();
    return;
  }
  const std::filesystem::path path = std::filesystem::path(scene_path).parent_path() / section.text("file");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    section.fail("file", "bond.file: there is no file \"" + path.string() +
                             "\"; allowed: final_bonds.csv of a run, or another CSV file, its path relative to the scene file");
  }
  rule.file = path;
  rule.pairs = reader.read_file(path);
}

BondRule read_bond(const TomlTable& section, const Scene& scene, const std::string& scene_path, Taken& taken) {
  BondRule rule;
  rule.name = section.text("name");
  if (rule.name.find_first_not_of(kNameCharacters) != std::string::npos) {
    section.fail("name", "bond.name is \"" + rule.name + "\"; allowed: letters, digits, _ and -");
  }
  if (std::ranges::any_of(scene.bonds, [&](const BondRule& other) { return other.name == rule.name; })) {
    section.fail("name", "bond.name is \"" + rule.name + "\", which another bond has; allowed: a name of its own");
  }
  rule.kind = section.choice("kind", {"beam", "ball"}) == "beam" ? BondKind::Beam : BondKind::Ball;
  rule.modulus = section.number("modulus", Interval::positive(kLargestModulus, "Pa"));
  if (rule.kind == BondKind::Beam) {
    rule.poisson_ratio = section.number("poisson_ratio", Interval::closed(0, 0.5, ""));
  } else if (section.has("poisson_ratio")) {
    section.fail("poisson_ratio", "bond.poisson_ratio of a ball, which does not twist; allowed: with kind = \"beam\"");
  }
  if (section.has("radius") && section.has("relative_radius")) {
    section.fail("relative_radius", "bond.relative_radius beside bond.radius; allowed: one of them");
  }
  if (section.has("radius")) rule.radius = section.number("radius", Interval::positive(kLargestLength, "m"));
  if (section.has("relative_radius")) {
    rule.relative_radius = section.number("relative_radius", Interval::positive(10, "(of the smallest half-axis)"));
  }
  const Interval strengths = Interval::positive(kLargestModulus, "Pa");
  if (section.has("tensile_strength")) rule.tensile_strength = section.number("tensile_strength", strengths);
  if (section.has("shear_strength")) rule.shear_strength = section.number("shear_strength", strengths);
  if (section.has("damping")) rule.damping = section.number("damping", Interval::closed(0, 1, "(of the critical damping)"));
  if (section.has("contacts")) rule.contacts = section.boolean("contacts");
  if (section.has("part")) rule.wall = read_part(section, scene);
  read_pairs(section, scene, scene_path, rule, taken);
  return rule;
}

}  // namespace

void load_bonds(const TomlTable& root, const std::string& scene_path, Scene& scene) {
  if (!root.has("bond")) return;
  Taken taken;
  for (const TomlTable& section : root.tables("bond", kBondKeys)) {
    scene.bonds.push_back(read_bond(section, scene, scene_path, taken));
  }
  if (std::holds_alternative<Periodic>(scene.container) || is_any(scene.periodic)) {
    root.fail("bond", "[[bond]] in a scene that repeats; allowed: in a container without periodic axes");
  }
}

}  // namespace falling_particles
