// The list of sections and keys, against what the loader takes and what it says of mistakes.
#include <doctest/doctest.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <supernormal/effects.hpp>
#include <vector>

#include "input/load_sections.hpp"
#include "scenes.hpp"

namespace {

using Keys = std::map<std::string, std::string>;  // what is said of each

/// The lines of the list by the line of their section. Keys that share a line, "x, y", have its text each.
std::map<std::string, Keys> listed() {
  std::map<std::string, Keys> sections;
  std::istringstream stream(falling_particles::kSectionsList);
  std::string section;
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("  ")) {
      section = line;
      continue;
    }
    const std::size_t end = std::min(line.find("  ", 2), line.size());
    std::istringstream names(line.substr(2, end - 2));
    for (std::string name; names >> name;) {
      if (name.back() == ',') name.pop_back();
      const bool is_new = sections[section].emplace(name, line.substr(end)).second;
      CHECK(is_new);
    }
  }
  return sections;
}

/// The keys that the loader accepts in a section, from its error about an unknown key. `also`: keys that the list has elsewhere.
std::set<std::string> taken(const std::vector<std::string>& overrides, const std::set<std::string>& also) {
  const std::string said = complaint(kSceneText, kCatalogueText, overrides);
  CAPTURE(said);
  const std::size_t at = said.find("; allowed: ");
  CHECK(said.find("unknown key \"no_such_key\"") != std::string::npos);
  std::set<std::string> keys;
  std::istringstream stream(said.substr(std::min(at + 11, said.size())));
  for (std::string key; stream >> key;) {
    if (key.back() == ',') key.pop_back();
    if (!also.contains(key)) keys.insert(key);
  }
  return keys;
}

struct Section {
  const char* line;                 // of the list
  std::string path;                 // of the section
  const char* valid;                // override that makes it a valid one, where the scene has another
  std::set<std::string> also = {};  // keys that are not in its lines: what chooses the kind
};

const std::vector<Section>& sections() {
  constexpr const char* kHopper =
      "container={kind = \"hopper\", outlet = 0.05, wall_angle = 30, diameter = 0.1, cylinder_height = 0.3, segments = 24, "
      "clearance = "
      "0.1, tray_width = 0.2, opens_at = 0.05, dish = {diameter = 0.1, height = 0.02, rim = 0.01}}";
  static const std::vector<Section> all = {
      {"[time]", "time", ""},
      {"[solver]", "solver", ""},
      {"[drop]", "drop", ""},
      {"[start]", "start", ""},
      {"[[bond]]", "bond[glue]", "bond=[{name = \"glue\"}]"},
      {"[[grain]]", "grain[pea]", ""},
      {"[grain.size] distribution = \"uniform\"",
       "grain[pea].size",
       "grain[pea].size={smallest = 1e-3, largest = 1e-2, distribution = \"uniform\"}",
       {"distribution"}},
      {"[grain.size] distribution = \"normal\"",
       "grain[pea].size",
       "grain[pea].size={smallest = 1e-3, largest = 1e-2, distribution = \"normal\", mean = 5e-3, deviation = 1e-3}",
       {"distribution"}},
      {"[grain.size] distribution = \"lognormal\"",
       "grain[pea].size",
       "grain[pea].size={smallest = 1e-3, largest = 1e-2, distribution = \"lognormal\", median = 5e-3, geometric_deviation = 1.2}",
       {"distribution"}},
      {"[grain.size] distribution = \"sieve\"",
       "grain[pea].size",
       "grain[pea].size={distribution = \"sieve\", openings = [1e-3, 2e-3], passing = [0, 1]}",
       {"distribution"}},
      {"[container] kind = \"box\"", "container", "", {"kind"}},
      {"[container] kind = \"hopper\"", "container", kHopper, {"kind"}},
      {"[container.dish]", "container.dish", kHopper},
      {"[container] kind = \"terrain\"",
       "container",
       "container={kind = \"terrain\", width = [0.2, 0.2], amplitude = 0.01, wavelength = 0.1, ridge_height = 0.01, samples = 20, "
       "seed = 1}",
       {"kind"}},
      {"[container] kind = \"periodic\"", "container", "container={kind = \"periodic\", side = 0.1}", {"kind"}},
      {"[container] kind = \"none\"", "container", "container={kind = \"none\"}", {"kind"}},
      {"[container] kind = \"drum\"",
       "container",
       "container={kind = \"drum\", diameter = 0.2, length = 0.1, segments = 24, rpm = 10}",
       {"kind"}},
      {"[container] kind = \"cell\"", "container", "container={kind = \"cell\", width = [0.1, 0.1], height = 0.1}", {"kind"}},
      {"[periodic]", "periodic", ""},
      {"[compression]", "compression", ""},
      {"[query]", "query", ""},
      {"[output]", "output", ""}};
  return all;
}

std::vector<std::string> with(const Section& section, const std::string& change) {
  std::vector<std::string> overrides;
  if (*section.valid != '\0') overrides.emplace_back(section.valid);
  overrides.push_back(change);
  return overrides;
}

}  // namespace

TEST_CASE("list: each section has exactly the keys that the loader accepts") {
  const std::map<std::string, Keys> list = listed();
  CHECK(list.size() == sections().size() + 1);  // the top of the file
  for (const Section& section : sections()) {
    CAPTURE(std::string(section.line));
    REQUIRE(list.contains(section.line));
    std::set<std::string> keys;
    for (const auto& [key, text] : list.at(section.line)) keys.insert(key);
    CHECK(keys == taken(with(section, section.path + ".no_such_key=1"), section.also));
  }
  // The loader has all sections of this list, and the sections of effects and of the other lists.
  std::set<std::string> others = {"part", "measurement", "feeder", "sink"};
  for (const std::string& effect : falling_particles::effect_sections()) others.insert(effect);
  std::set<std::string> top = {"seed", "catalogue"};
  for (const Section& section : sections()) top.insert(section.path.substr(0, section.path.find_first_of(".[")));
  CHECK(top == taken({"no_such_key=1"}, others));
}

TEST_CASE("list: each range agrees with the loader's error") {
  const std::regex range(R"([\[(]-?[0-9.e+]+, [0-9.e+]+[\])]|a whole number from \d+ to \d{1,9}\b)");
  int compared = 0;
  const std::map<std::string, Keys> list = listed();
  for (const Section& section : sections()) {
    for (const auto& [key, told] : list.at(section.line)) {
      const std::string& text = told;  // lambdas do not capture structured bindings
      const std::string said = complaint(kSceneText, kCatalogueText, with(section, section.path + '.' + key + "={}"));
      const std::size_t at = said.find(key + " is a table; allowed: ");
      const bool depends_on_others = std::regex_search(said, std::regex("allowed: .*\\([a-z]"));
      std::smatch found;
      const std::string allowed = at == std::string::npos ? "" : said.substr(at);
      if (depends_on_others || text.find("as above") != std::string::npos || !std::regex_search(allowed, found, range)) continue;
      CAPTURE(std::string(section.line));
      CAPTURE(said);
      CAPTURE(text);
      const std::string named = std::regex_replace(found.str(), std::regex("1e\\+0(\\d)"), "1e$1");
      const bool is_listed = text.find(named == "[0, 1e9]"   ? "[0, 1000000000]"
                                       : named == "(0, 1e6]" ? "(0, 1000000]"
                                                             : named) != std::string::npos;
      CHECK(is_listed);
      ++compared;
    }
  }
  CHECK(compared > 30);
}

TEST_CASE("list: the section of each effect names every key that scenes may have in it") {
  for (const supernormal::effects::Description& effect : supernormal::effects::descriptions()) {
    const std::string text = falling_particles::scene_parameters(effect);
    CAPTURE(text);
    const std::string path = std::string(effect.name) + ".no_such_key=1";
    for (const std::string& key : taken({path}, {})) {
      if (key == "enabled") continue;  // of all, and said once above them
      CAPTURE(key);
      CHECK(std::regex_search(text, std::regex("\\b" + key + "\\b")));
    }
  }
}

TEST_CASE("list: walls and populations are listed with every key that a section allows") {
  const auto check_listed = [](const std::string& list, const std::string& section) {
    const std::string said = complaint(kSceneText + section + "nonsense = 1\n");
    CAPTURE(section);
    REQUIRE(said.find("nonsense") != std::string::npos);
    REQUIRE(said.find("allowed: ") != std::string::npos);
    std::istringstream stream(said.substr(said.find("allowed: ") + 9));
    for (std::string key; stream >> key;) {
      if (key.back() == ',') key.pop_back();
      CAPTURE(key);
      const bool is_listed = list.find(key) != std::string::npos;
      CHECK(is_listed);
    }
  };
  const std::string walls = falling_particles::kWallsList, population = falling_particles::kPopulationList;
  for (const std::string shape : {"plane", "box", "cylinder", "mesh", "ellipsoid", "superellipsoid", "superovoid"}) {
    CHECK(walls.find("[[part]] shape = \"" + shape + '"') != std::string::npos);
    check_listed(walls, "[[part]]\nname = \"p\"\nshape = \"" + shape + "\"\n");
  }
  const std::string part = "[[part]]\nname = \"p\"\nshape = \"plane\"\n";
  for (const std::string kind : {"velocity", "rotation", "vibration", "conveyor"}) {
    CHECK(walls.find("[[part.motion]] kind = \"" + kind + '"') != std::string::npos);
    check_listed(walls, std::string(part).append("[[part.motion]]\nkind = \"").append(kind).append("\"\n"));
  }
  check_listed(walls, part + "[part.drive]\n");
  check_listed(population, "[[feeder]]\n");
  check_listed(population, "[[sink]]\n");
}
