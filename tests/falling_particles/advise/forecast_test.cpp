// What a scene would do, in words.
#include "advise/forecast.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "scenes.hpp"

using namespace falling_particles;

TEST_CASE("check: a forecast counts steps, frames, grains and samples") {
  const Scene scene =
      scene_of(std::string(kSceneText) +
               "[[feeder]]\nname = \"f\"\ncorner = [0, 0, 0.1]\nsize = [0.05, 0.06, 0.05]\ngrains_per_second = 100\n"
               "[[measurement]]\nkind = \"stress\"\nlower = [0, 0, 0]\nupper = [0.05, 0.06, 0.1]\ninterval = 0.02\n"
               "[[measurement]]\nkind = \"grid\"\nlower = [0, 0, 0]\nupper = [0.05, 0.06, 0.1]\ncells = [1, 1, 2]\n"
               "interval = 0.02\nfrom = 0.03\nuntil = 0.08\n");
  const Forecast result = forecast(scene);
  CHECK(result.steps == 200);
  CHECK(result.timed_steps == 20);
  CHECK(result.step > 0);
  CHECK(result.seconds() == doctest::Approx(200 * result.step));
  CHECK(result.frames == 11);
  CHECK(result.most_grains >= 7 + 10);
  CHECK(result.most_grains <= 7 + 12);
  CHECK(result.samples == std::vector<std::uint64_t>{5, 3});  // stress has none at the start, where there are no contacts
  const std::string text = describe(scene, result);
  for (const char* line : {"scene         scene, in a box", "steps         200 of 5e-04 s, 11 frames",
                           "7 at the start: 5 pea, 2 die", "measurements  stress: stress, 5 samples", "friction: "}) {
    CAPTURE(text);
    CHECK(text.find(line) != std::string::npos);
  }
}

TEST_CASE("check: effects on walls are told from those among grains") {
  const Scene scene = scene_of(replaced(kSceneText, "coefficient = 0.4", "coefficient = 0.4\nwalls = 0.1") +
                               "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.01, 0.01, 0.01]\nposition = [0.02, 0.02, 0.5]\n"
                               "friction = 0.2\nrestitution = 0.5\n");
  const std::string text = describe(scene, forecast(scene));
  for (const char* line :
       {"friction: 2 rows", "friction on walls: 2 rows", "friction on part \"p\": 2 rows", "restitution on part \"p\": "}) {
    CAPTURE(line);
    CHECK(text.find(line) != std::string::npos);
  }
}

TEST_CASE("check: the files of a run are as large as forecast") {
  const Scene scene = load_scene(std::string(SUPERNORMAL_SAMPLES) + "/scenes/short.toml");
  const Forecast result = forecast(scene);
  CHECK(result.table_bytes == doctest::Approx(520265).epsilon(0.03));  // trajectory.csv, energies.csv, state.csv, final_state.csv
  CHECK(result.picture_bytes == doctest::Approx(1216641).epsilon(0.15));  // view.html, scene.glb
}

TEST_CASE("check: a table of events is forecast to have a line for each grain") {
  const auto bytes = [](const std::string& more) { return forecast(scene_of(kSceneText + more)).table_bytes; };
  const std::string visits =
      "[[measurement]]\nkind = \"residence\"\nlower = [0, 0, 0]\nupper = [1, 1, 1]\ninterval = 0.1\nper = \"visit\"\n";
  CHECK(bytes(visits) - bytes("") == doctest::Approx(7 * 80).epsilon(0.2));
}

TEST_CASE("check: a run that ends before twenty steps is timed to its end") {
  CHECK(forecast(scene_of(std::string(kSceneText), {"time.duration=1e-3", "time.frame=1e-3"})).timed_steps == 2);
}
