// What a scene would do, and what it may name, in words.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "input/list_sections.hpp"
#include "observe/simulation.hpp"
#include "run/forecast.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

Scene load(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  return load_scene(folder.write("scene.toml", text));
}

/// The keys that a section allows, by the complaint about another one.
std::vector<std::string> keys_of(const std::string& section) {
  std::string text;
  try {
    load(std::string(kSceneText) + section + "nonsense = 1\n");
  } catch (const InputError& error) {
    text = error.what();
  }
  const std::string allowed = "allowed: ";
  REQUIRE(text.find("nonsense") != std::string::npos);
  REQUIRE(text.find(allowed) != std::string::npos);
  std::istringstream stream(text.substr(text.find(allowed) + allowed.size()));
  std::vector<std::string> keys;
  for (std::string key; std::getline(stream, key, ',');) keys.push_back(key.substr(key.find_first_not_of(' ')));
  return keys;
}

void check_listed(const std::string& list, const std::string& section) {
  for (const std::string& key : keys_of(section)) {
    CAPTURE(section);
    CAPTURE(key);
    const bool is_listed = list.find(key) != std::string::npos;
    CHECK(is_listed);
  }
}

/// s, the least of the last fifty steps until `step`: whatever else the machine does.
double seconds_of_step(const Scene& scene, int step) {
  Simulation simulation(scene, 1);
  for (int i = 0; i < step - 50; ++i) simulation.stepper.step();
  double least = 1;
  for (int i = 0; i < 50; ++i) {
    const auto start = std::chrono::steady_clock::now();
    simulation.stepper.step();
    least = std::min(least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

}  // namespace

TEST_CASE("check: lists name every key that a section allows") {
  for (const char* shape : {"plane", "box", "cylinder", "mesh", "ellipsoid", "superellipsoid", "superovoid"}) {
    CHECK(list_walls().find("[[part]] shape = \"" + std::string(shape) + '"') != std::string::npos);
    check_listed(list_walls(), "[[part]]\nname = \"p\"\nshape = \"" + std::string(shape) + "\"\n");
  }
  const std::string part = "[[part]]\nname = \"p\"\nshape = \"plane\"\n";
  for (const char* kind : {"velocity", "rotation", "vibration", "conveyor"}) {
    CHECK(list_walls().find("[[part.motion]] kind = \"" + std::string(kind) + '"') != std::string::npos);
    check_listed(list_walls(), part + "[[part.motion]]\nkind = \"" + kind + "\"\n");
  }
  check_listed(list_walls(), part + "[part.drive]\n");
  check_listed(list_population(), "[[feeder]]\n");
  check_listed(list_population(), "[[sink]]\n");
}

TEST_CASE("check: a forecast counts steps, frames, grains and samples") {
  const Scene scene = load(std::string(kSceneText) +
                           "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.1]\nsize = [0.05, 0.06, 0.05]\ngrains_per_second = 100\n"
                           "[[measurement]]\nkind = \"stress\"\nlower = [0, 0, 0]\nupper = [0.05, 0.06, 0.1]\ninterval = 0.02\n"
                           "[[measurement]]\nkind = \"grid\"\nlower = [0, 0, 0]\nupper = [0.05, 0.06, 0.1]\ncells = [1, 1, 2]\n"
                           "interval = 0.02\nfrom = 0.03\nuntil = 0.08\n");
  const Forecast result = forecast(scene);
  CHECK(result.steps == 200);
  CHECK(result.frames == 11);
  CHECK(result.most_grains >= 7 + 10);
  CHECK(result.most_grains <= 7 + 12);
  CHECK(result.samples == std::vector<std::uint64_t>{5, 3});  // stress has none at the start, where there are no contacts
  const std::string text = describe(scene, result);
  for (const char* line :
       {"scene         scene, in a box", "steps         200 of 5e-04 s, 11 frames", "7 at the start: 5 pea, 2 die",
        "feeders       f: 100 grains/s", "measurements  stress: stress, 5 samples", "friction: "}) {
    CAPTURE(text);
    CHECK(text.find(line) != std::string::npos);
  }
}

TEST_CASE("check: friction of grains on walls is told from friction among grains") {
  const Scene scene = load(replaced(kSceneText, "[friction]\ncoefficient = 0.4", "[friction]\ncoefficient = 0.4\nwalls = 0.1"));
  const std::string text = describe(scene, forecast(scene));
  CHECK(text.find("friction: 2 rows") != std::string::npos);
  CHECK(text.find("friction on walls: 2 rows") != std::string::npos);
  const Scene own = load(kSceneText + std::string("[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.01, 0.01, 0.01]\n"
                                                  "position = [0.02, 0.02, 0.5]\nfriction = 0.2\nrestitution = 0.5\n"));
  const std::string labelled = describe(own, forecast(own));
  CHECK(labelled.find("friction on part \"p\": 2 rows") != std::string::npos);
  CHECK(labelled.find("restitution on part \"p\": ") != std::string::npos);
}

TEST_CASE("check: the files of a run are as large as forecast") {
  const Scene scene = load_scene(std::string(SUPERNORMAL_SAMPLES) + "/scenes/short.toml");
  const Forecast result = forecast(scene);
  CHECK(result.table_bytes == doctest::Approx(520265).epsilon(0.03));  // trajectory.csv, energies.csv, state.csv, final_state.csv
  CHECK(result.picture_bytes == doctest::Approx(1216641).epsilon(0.15));  // view.html, scene.glb
}

TEST_CASE("check: a table of events is forecast to have a line for each grain") {
  const auto bytes = [](const std::string& more) { return forecast(load(kSceneText + more)).table_bytes; };
  const std::string visits =
      "[[measurement]]\nkind = \"residence\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\ninterval = 0.1\nper = \"visit\"\n";
  CHECK(bytes(visits) - bytes("") == doctest::Approx(7 * 80).epsilon(0.2));
}

TEST_CASE("check: a step of a bed takes as long as forecast, to a factor of two") {
  const Scene scene = load_scene(std::string(SUPERNORMAL_SAMPLES) + "/scenes/short.toml");
  const double forecast_step = forecast(scene).bed_step();
  const double step = seconds_of_step(scene, 1000);
  CAPTURE(forecast_step);
  CAPTURE(step);
  CHECK(forecast_step < 2 * step);
  CHECK(forecast_step > step / 2);
}
