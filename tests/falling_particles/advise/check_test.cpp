// What --check says: refusals of a start, and the forecast.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "advise/doubts.hpp"
#include "advise/forecast.hpp"
#include "advise/refusals.hpp"
#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "scenes.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

constexpr const char* kHead = "grain,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s\n";

/// The scene of scenes.hpp, 0.05 m by 0.06 m, with peas of 3 mm from a state.
Scene with_state(const TemporaryFolder& folder, const std::string& grains, std::vector<std::string> overrides = {}) {
  folder.write("grains.toml", kCatalogueText);
  folder.write("state.csv", kHead + grains);
  overrides.emplace_back("start.file=\"state.csv\"");
  return load_scene(folder.write("scene.toml", kSceneText), overrides);
}

std::string refusal_of_start(const std::string& grains, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  const Scene scene = with_state(folder, grains, overrides);
  return refusal_by([&] { refuse_bad_start(scene); });
}

std::string pea_at(double x, double y, double z) {
  return "pea," + shortest(x) + ',' + shortest(y) + ',' + shortest(z) + ",1,0,0,0,0,0,0\n";
}

}  // namespace

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

TEST_CASE("check: the step that the stepper takes is proposed, beside quickstep's") {
  const Scene scene = scene_of(kSceneText, {"solver={kind = \"stepper\"}"});
  const double fall = scene.smallest_half_axis() / scene.gravity()->acceleration.norm();  // s^2
  const std::string line = "time.step up to " + rounded(std::sqrt(10 * fall)) + " s would do, with quickstep up to " +
                           rounded(std::sqrt(0.1 * fall)) + " s";
  CHECK(describe(scene, forecast(scene)).find(line) != std::string::npos);
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

TEST_CASE("start: grains that overlap too deeply are refused with the pair and its depth") {
  const std::string two = pea_at(0.02, 0.03, 0.01) + pea_at(0.02, 0.0358, 0.01);  // 0.2 mm deep, of 3 mm
  CHECK(refusal_of_start(two).empty());
  const std::string deep = pea_at(0.02, 0.03, 0.01) + pea_at(0.02, 0.035, 0.01);
  check_says(refusal_of_start(deep), {"state.csv:", "the pea is 0.001 m deep in the pea of line", "0.333 of the smallest half-axis",
                                      "allowed: up to 0.1, start.overlap"});
  CHECK(refusal_of_start(deep, {"start.overlap=0.34"}).empty());
  check_says(refusal_of_start(two, {"start.overlap=0.06"}), {"allowed: up to 0.06, start.overlap"});
}

TEST_CASE("start: overlaps across a periodic boundary count") {
  const std::string two = pea_at(1e-3, 0.03, 0.01) + pea_at(0.048, 0.03, 0.01);
  CHECK(!refusal_of_start(two).empty());  // beyond a wall
  check_says(refusal_of_start(two, {"periodic.x=[0, 0.05]"}), {"the pea is 0.003 m deep in the pea of line"});
  CHECK(refusal_of_start(two, {"periodic.x=[0, 0.05]", "grain[pea].count=2", "start.overlap=1"}).empty());
}

TEST_CASE("start: grains beyond a wall are refused by its name") {
  check_says(refusal_of_start(pea_at(0.02, 0.03, 0.01) + pea_at(0.02, 0.03, 2e-3)),
             {"state.csv:3: the pea is 0.001 m deep in wall \"floor\""});
  check_says(refusal_of_start(pea_at(0.06, 0.03, 0.01)), {"state.csv:2: the pea is 0.013 m deep in wall \"x_high\""});
  const std::string part = R"(part=[{name = "block", shape = "box", size = [0.01, 0.01, 0.01], position = [0.02, 0.03, 0.01]}])";
  check_says(refusal_of_start(pea_at(0.02, 0.03, 0.016), {part}), {"the pea is 0.002 m deep in part \"block\""});
  CHECK(refusal_of_start(pea_at(0.02, 0.03, 0.0179), {part}).empty());
}

TEST_CASE("start: a grain outside a container without walls there is refused") {
  const std::string open =
      "container={kind = \"none\", start = {corner = [0, 0, 0], size = [0.1, 0.1, 0.1]}, bounds = {corner = [0, 0, 0], size = [1, "
      "1, 1]}}";
  const std::string part = R"(part=[{name = "block", shape = "box", size = [0.01, 0.01, 0.01], position = [0.02, 0.03, 0.01]}])";
  check_says(refusal_of_start(pea_at(0.5, 0.5, 0.5) + pea_at(0.5, 0.5, 1.5), {open, part}),
             {"state.csv:3: the pea is at [0.5, 0.5, 1.5] m, outside the container, a none; allowed: inside"});
}

TEST_CASE("start: --check says where the grains come from, and doubts fast ones") {
  const TemporaryFolder folder;
  const Scene scene = with_state(folder, "pea,0.02,0.03,0.01,1,0,0,0,0,0,-8\n");
  CHECK(describe(scene, forecast(scene)).find("start         from state.csv; the fastest grain has 8 m/s") != std::string::npos);
  const std::vector<std::string> doubts = doubts_about(scene);
  const auto is_about_speed = [](const std::string& doubt) {
    return doubt.find("the fastest grain of start.file moves 0.004 m") == 0;
  };
  CHECK(std::ranges::count_if(doubts, is_about_speed) == 1);
  CHECK(!fall_from_start(scene).has_value());
}
