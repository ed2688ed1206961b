#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "input/catalogue.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;
namespace fx = supernormal::effects;

namespace {

template <typename E>
E effect(const Scene& scene) {
  for (const fx::Effect& each : scene.effects) {
    if (const E* found = std::get_if<E>(&each)) return *found;
  }
  FAIL("the scene has no such effect");
  return {};
}

}  // namespace

TEST_CASE("sections that a scene lacks are listed together") {
  check_says(complaint(""), {"seed, catalogue, time, container, grain, solver are missing"});
  check_says(complaint("seed = 1\n"), {"catalogue, time, container, grain, solver are missing"});
}

TEST_CASE("the values of a scene file are read") {
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  const Scene scene = load_scene(folder.write("my.scene.toml", kSceneText));
  CHECK(scene.name == "my.scene");
  CHECK(scene.seed == 7);
  CHECK(std::get<Box>(scene.container).width == std::array<double, 2>{0.05, 0.06});
  CHECK(scene.grains_at_start() == 7);
  REQUIRE(scene.kinds.size() == 2);
  CHECK(scene.kinds[1].kind.name == "die");
  CHECK(scene.kinds[1].kind.rounding == 1e-3);
  CHECK(scene.kinds[1].count == 2);
  CHECK(scene.time.steps() == 200);
  CHECK(scene.time.steps_per_frame() == 20);
  CHECK(scene.smallest_half_axis() == 3e-3);
  REQUIRE(scene.gravity() != nullptr);
  CHECK(scene.gravity()->acceleration == supernormal::Vector3(0, 0, -9.81));
  CHECK(effect<fx::Friction>(scene).coefficient == 0.4);
  CHECK(effect<fx::SurfaceLayer>(scene).depth == supernormal::test::relative(0.002 * 3e-3).epsilon(1e-12));
}

TEST_CASE("every effect of the library has a section") {
  // Each section is refused or read, but known: its name is not an unknown key.
  for (const fx::Description& description : fx::descriptions()) {
    const std::string name = description.name;
    CAPTURE(name);
    if (std::string(kSceneText).find("[" + name + "]") != std::string::npos) continue;
    const std::string text = complaint(std::string(kSceneText) + "[" + name + "]\nnothing = 1\n");
    CHECK(text.find("unknown key \"nothing\" in [" + name + "]") != std::string::npos);
  }
}

TEST_CASE("walls may have their own friction") {
  const Scene scene = scene_of(replaced(kSceneText, "coefficient = 0.4", "coefficient = 0.4\nwalls = 0.1"));
  std::vector<fx::Friction> found;
  for (const fx::Effect& each : scene.effects) {
    if (const auto* friction = std::get_if<fx::Friction>(&each)) found.push_back(*friction);
  }
  REQUIRE(found.size() == 2);
  CHECK(found[1].coefficient == 0.1);
  CHECK(found[1].on.is_pair());
}

TEST_CASE("walls may have their own rolling resistance") {
  const Scene scene = scene_of(std::string(kSceneText) + "[rolling_resistance]\nrolling = 1e-4\nspinning = 3e-5\nwalls = 2e-4\n");
  std::vector<fx::RollingResistance> found;
  for (const fx::Effect& each : scene.effects) {
    if (const auto* resistance = std::get_if<fx::RollingResistance>(&each)) found.push_back(*resistance);
  }
  REQUIRE(found.size() == 2);
  CHECK(found[0].on.is_all());
  CHECK(found[0].rolling == 1e-4);
  CHECK(found[1].on.is_pair());
  CHECK(found[1].rolling == 2e-4);
  CHECK(found[1].spinning == 3e-5);
}

TEST_CASE("an effect without a section is absent") {
  const Scene scene = scene_of(std::string(kSceneText, std::strstr(kSceneText, "[gravity]")));
  CHECK(scene.gravity() == nullptr);
  CHECK(scene.effects.size() == 2);
}

TEST_CASE("every effect may be left out by a key of its section, whether the scene has the section or not") {
  const auto names_of = [](const Scene& scene) {
    std::vector<std::string> names;
    for (const fx::Effect& each : scene.effects) names.emplace_back(fx::descriptions()[each.index()].name);
    return names;
  };
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  const std::filesystem::path path = folder.write("scene.toml", kSceneText);
  const std::vector<std::string> all = names_of(load_scene(path));
  for (const fx::Description& description : fx::descriptions()) {
    const std::string name = description.name;
    CAPTURE(name);
    std::vector<std::string> others = all;
    std::erase(others, name);
    CHECK(names_of(load_scene(path, {name + ".enabled=false"})) == others);
  }
  CHECK(names_of(load_scene(path, {"friction.enabled=true"})) == all);
  CHECK(complaint(std::string(kSceneText) + "[damping]\nenabled = 0\n").find("damping.enabled is 0") != std::string::npos);
}

TEST_CASE("fractions become counts that sum to the total") {
  std::string text = replaced(kSceneText, "count = 5", "fraction = 0.335");
  text = replaced(text, "count = 2", "fraction = 0.665");
  text = replaced(text, "gap = 0.1", "gap = 0.1\ntotal = 10");
  const Scene scene = scene_of(text);
  CHECK(scene.kinds[0].count == 3);
  CHECK(scene.kinds[1].count == 7);
}

TEST_CASE("every mistake in a scene file ends with one line: file, line, what is allowed") {
  const std::vector<Mistake> mistakes = {
      {"[friction]", "[frction]", {"scene.toml:29: unknown key \"frction\" at the top", "did you mean \"friction\"?"}},
      {"width = [0.05, 0.06]",
       "width = [0.05, 0.015]",
       {"scene.toml:5: container.width is 0.015", "at least 0.018", "largest grain"}},
      {"kind = \"box\"", "", {"scene.toml:3: container.kind is missing; allowed: box, hopper, terrain"}},
      {"kind = \"box\"", "kind = 3", {"scene.toml:4: container.kind is 3; allowed: a string"}},
      {"width = [0.05, 0.06]", "", {"scene.toml:3: container.width is missing"}},
      {"step = 0.0005", "step = nan", {"scene.toml:17: time.step is nan"}},
      {"step = 0.0005", "step = \"fast\"", {"scene.toml:17: time.step is the string \"fast\"; allowed: a number"}},
      {"duration = 0.1", "duration = inf", {"scene.toml:16: time.duration is inf"}},
      {"frame = 0.01", "frame = 0.0001", {"scene.toml:18: time.frame is 1e-04", "[5e-04, 0.1]"}},
      {"iterations = 20", "iterations = 2.5", {"scene.toml:20: solver.iterations is 2.5; allowed: a whole number"}},
      {"coefficient = 0.4", "coefficient = 0", {"scene.toml:30: friction: coefficient = 0 is outside (0, 100]"}},
      {"coefficient = 0.4",
       "coefficient = nan",
       {"scene.toml:30: friction.coefficient is nan; allowed: a number: coefficient (0, 100]"}},
      {"coefficient = 0.4", "", {"scene.toml:29: friction.coefficient is missing"}},
      {"[friction]\n",
       "[compliance]\nstiffness = 1e4\n[friction]\n",
       {"max_correcting_velocity is listed with compliance or hertz"}},
      {"[friction]\n",
       "[restitution]\ncoefficient = 0.5\nthreshold = -1\n[friction]\n",
       {"scene.toml:31: restitution: threshold = -1 m/s is outside [0, 100] m/s"}},
      {"[gravity]\nacceleration = [0, 0, -9.81]",
       "[buoyancy]\ndensity = 1000\nlevel = 0",
       {"scene.toml:27: buoyancy is listed without gravity"}},
      {"seed = 7", "seed = -1", {"scene.toml:1: seed is -1"}},
      {"seed = 7", "seed = 7\nseed = 8", {"scene.toml:2: ", "seed"}},
      {"seed = 7", "seed = ", {"scene.toml:1: ", "valid TOML"}},
      {"name = \"pea\"", "name = \"pae\"", {"scene.toml:10: unknown grain \"pae\"", "did you mean \"pea\"?", "pea, die"}},
      {"name = \"pea\"", "name = \"die\"", {"scene.toml:13: grain \"die\" is listed twice"}},
      {"count = 2", "fraction = 0.5", {"scene.toml:14: grain.fraction is mixed with count"}},
      {"count = 2", "count = 0", {"scene.toml:14: grain.count is 0; allowed: a whole number from 1"}},
      {"count = 2",
       "count = 1e3",
       {"scene.toml:14: grain.count is 1000; allowed: a whole number from 1", "without a point and an exponent"}},
      {"catalogue = \"grains.toml\"", "catalogue = \"grain.toml\"", {"scene.toml:2: catalogue: there is no file", "grain.toml"}},
      {"catalogue = \"grains.toml\"",
       "catalogue = \".\"",
       {"scene.toml:2: catalogue: \".\" is a folder", "allowed: a grain catalogue, its path relative to the scene file"}},
  };
  for (const Mistake& mistake : mistakes) check_says(complaint(replaced(kSceneText, mistake.from, mistake.to)), mistake.says);
}

TEST_CASE("a scene names its pictures") {
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  const auto pictures_of = [&](const std::string& output) {
    return load_scene(folder.write("scene.toml", kSceneText + output)).pictures;
  };
  CHECK(pictures_of("") == std::vector<std::string>{"page", "glb", "plots"});
  CHECK(pictures_of("[output]\n") == std::vector<std::string>{"page", "glb", "plots"});
  CHECK(pictures_of("[output]\npictures = []\n").empty());
  CHECK(pictures_of("[output]\n"
                    R"(pictures = ["povray", "vtk"])"
                    "\n") == std::vector<std::string>{"povray", "vtk"});
  for (const char* wrong : {R"("glb")", R"(["gltf"])", "[1]", R"(["vtk", "vtk"])"}) {
    std::string scene(kSceneText);
    scene.append("[output]\npictures = ").append(wrong).append("\n");
    const std::string text = complaint(scene);
    CHECK(text.find("pictures") != std::string::npos);
    CHECK(text.find("allowed: an array of different words of: page, glb, lammps, vtk, povray") != std::string::npos);
  }
}

TEST_CASE("pictures show forces if the scene requests them") {
  const std::string text = kSceneText;
  CHECK_FALSE(scene_of(text).forces);
  CHECK(scene_of(text + "[output]\nforces = true\n").forces);
  check_says(complaint(text + "[output]\nforces = 1\n"), {"output.forces", "allowed: true or false"});
}

TEST_CASE("fractions that do not sum to one are refused") {
  std::string text = replaced(kSceneText, "count = 5", "fraction = 0.5");
  text = replaced(text, "count = 2", "fraction = 0.4");
  check_says(complaint(replaced(text, "gap = 0.1", "gap = 0.1\ntotal = 10")),
             {"scene.toml:12: ", "sum to 0.9", "allowed: a sum of 1"});
  check_says(complaint(text), {"scene.toml:6: drop.total is missing"});
}

TEST_CASE("every mistake in a catalogue ends with one line too") {
  const std::vector<Mistake> mistakes = {
      {"delta = 8", "delta = 1", {"grains.toml:10: die.delta is 1;", "[1.01, 1000]"}},
      {"epsilon = 8", "epsilon = 0.5", {"grains.toml:11: die.epsilon is 0.5;", "[1.01, 1000]"}},
      {"half_axes = [3e-3, 3e-3, 3e-3]",
       "half_axes = [3e-3, -3e-3, 3e-3]",
       {"grains.toml:2: pea.half_axes[1] is -0.003", "(0, 1] m"}},
      {"half_axes = [3e-3, 3e-3, 3e-3]", "half_axes = [3e-3, 3e-3, 0]", {"grains.toml:2: pea.half_axes[2] is 0"}},
      {"rounding = 1e-3", "rounding = 6e-3", {"grains.toml:12: die.rounding is 0.006", "[0, 0.006)"}},
      {"density = 1200", "densty = 1200", {"grains.toml:5: unknown key \"densty\" in [pea]", "did you mean \"density\"?"}},
      {"density = 1200", "density = 0", {"grains.toml:5: pea.density is 0", "kg/m^3"}},
      {"density = 1200", "", {"grains.toml:1: pea.density is missing"}},
      {"[pea]", "[die]", {"grains.toml:8: ", "die"}},
      {"[pea]", "[\"a,b\"]", {"grains.toml:1: grain name \"a,b\"", "allowed: letters"}},
      {"[pea]", "colour = 3\n[pea]", {"grains.toml:1: colour is 3; allowed: a table"}},
  };
  for (const Mistake& mistake : mistakes) {
    check_says(complaint(kSceneText, replaced(kCatalogueText, mistake.from, mistake.to)), mistake.says);
  }
}

TEST_CASE("files that cannot be read") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(load_scene("/nowhere/scene.toml"),
                       "cannot read scene file \"/nowhere/scene.toml\": No such file or directory", InputError);
  CHECK_THROWS_AS(load_scene(folder.path().string()), InputError);
}

TEST_CASE("the catalogues are valid and name their sources, and the scenes load") {
  for (const char* catalogue : {"grains", "shapes", "compounds"}) {
    const auto entries = open_catalogue(std::string(SUPERNORMAL_SAMPLES "/data/") + catalogue + ".toml");
    CHECK(entries.size() >= 3);
    for (const CatalogueEntry& entry : entries) {
      const GrainKind kind = entry.make();
      CAPTURE(kind.name);
      CHECK_FALSE(kind.source.empty());
      CHECK(kind.bounding_radius() < 0.05);
    }
  }
  for (const char* scene : {"mixture", "short", "hopper", "terrain", "heap", "packing_spheres", "packing_ellipsoids", "packing_mm",
                            "packing_superballs", "tower", "sizes", "compounds", "rods", "triaxial"})
    load_scene(std::string(SUPERNORMAL_SAMPLES "/scenes/") + scene + ".toml");
}
