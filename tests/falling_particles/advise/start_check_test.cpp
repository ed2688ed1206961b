// Scenes that start from a state: what is refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "advise/doubts.hpp"
#include "advise/forecast.hpp"
#include "advise/refusals.hpp"
#include "advise/step.hpp"
#include "common/input_error.hpp"
#include "common/interval.hpp"
#include "complaint.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

constexpr const char* kHead = "grain,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s\n";

/// The scene of scene_text.hpp, 0.05 m by 0.06 m, with peas of 3 mm from a state.
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
