#include <doctest/doctest.h>

#include <string>
#include <variant>
#include <vector>

#include "complaint.hpp"
#include "scenes.hpp"

using namespace falling_particles;
namespace fx = supernormal::effects;

namespace {

std::vector<fx::Friction> frictions(const Scene& scene) {
  std::vector<fx::Friction> found;
  for (const fx::Effect& each : scene.effects) {
    if (const auto* friction = std::get_if<fx::Friction>(&each)) found.push_back(*friction);
  }
  return found;
}

}  // namespace

TEST_CASE("an override replaces a number, an element, and entries by number and by name") {
  const std::vector<std::string> overrides = {"seed=8", "time.step=1e-3", "container.width[1]=0.07", "grain[0].count=6",
                                              "grain[die].count= 3 # dice"};
  const Scene scene = scene_of(kSceneText, overrides);
  CHECK(scene.seed == 8);
  CHECK(scene.time.step == 1e-3);
  CHECK(std::get<Box>(scene.container).width == std::array<double, 2>{0.05, 0.07});
  CHECK(scene.kinds[0].count == 6);
  CHECK(scene.kinds[1].count == 3);
  CHECK(scene.overrides == overrides);
  CHECK(scene_of(kSceneText).overrides.empty());
}

TEST_CASE("an override replaces whole entries, arrays and tables, and adds keys and sections") {
  const Scene scene = scene_of(kSceneText, {R"(grain[pea]={name = "pea", count = 9})", "container.width=[0.1, 0.2]",
                                            "friction.walls=0.1", "output.pictures=[]", "damping.linear=1e-3"});
  CHECK(scene.kinds[0].count == 9);
  CHECK(std::get<Box>(scene.container).width == std::array<double, 2>{0.1, 0.2});
  REQUIRE(frictions(scene).size() == 2);
  CHECK(frictions(scene)[1].coefficient == 0.1);
  CHECK(scene.pictures.empty());
  CHECK(scene.effects.size() == scene_of(kSceneText).effects.size() + 2);  // friction of the walls, and damping
}

TEST_CASE("of two overrides of a value the later one holds, and sees what the earlier one set") {
  CHECK(scene_of(kSceneText, {"seed=8", "seed=9"}).seed == 9);
  CHECK(scene_of(kSceneText, {R"(grain=[{name = "die", count = 1}])", "grain[die].count=2"}).grains_at_start() == 2);
}

TEST_CASE("an override with an empty array removes sections") {
  const std::string part = std::string(kSceneText) +
                           "[[part]]\nname = \"p\"\nshape = \"plane\"\nposition = [0, 0, -1]\n"
                           "[[part.motion]]\nkind = \"velocity\"\nvelocity = [0, 0, -1]\n";
  CHECK(scene_of(part).parts().front().motions.size() == 1);
  CHECK(scene_of(part, {"part[p].motion=[]"}).parts().front().motions.empty());
  CHECK(scene_of(part, {"part=[]"}).parts().empty());
  check_says(complaint(kSceneText, kCatalogueText, {"grain=[]"}), {"grain is missing"});
}

TEST_CASE("an entry without a name has that of its kind") {
  const std::string text = std::string(kSceneText) + "[[measurement]]\nkind = \"coordination\"\ninterval = 0.01\n";
  CHECK(scene_of(text, {"measurement[coordination].interval=0.02"}).measurements.front().every == 40);
}

TEST_CASE("a scene with overrides is the scene with these values written into it") {
  const Scene written = scene_of(replaced(replaced(kSceneText, "seed = 7", "seed = 3"), "count = 5", "count = 4"));
  const Scene set = scene_of(kSceneText, {"seed=3", "grain[pea].count=4"});
  CHECK(set.seed == written.seed);
  CHECK(set.kinds[0].count == written.kinds[0].count);
  CHECK(set.grains_at_start() == written.grains_at_start());
}

TEST_CASE("a mistake in an override ends with one line that names the option") {
  struct Wrong {
    const char* assignment;
    std::vector<const char*> says;
  };
  const std::vector<Wrong> mistakes = {
      {"time.step=-1", {"--set time.step=-1: time.step is -1; allowed: a number in (0, 0.1] s"}},
      {"time.stp=1e-3", {R"(--set time.stp=1e-3: unknown key "stp" in [time]; did you mean "step"?)"}},
      {"tme.step=1e-3", {"--set tme.step=1e-3: unknown key \"tme\" at the top", "did you mean \"time\"?"}},
      {"container.width[1]=-1", {"--set container.width[1]=-1: container.width[1] is -1", "(0, 1000] m"}},
      {"container.width=[0.1]", {"--set container.width=[0.1]: container.width is an array of 1; allowed: an array of 2"}},
      {"container.kind=\"bx\"", {"--set container.kind=\"bx\": ", "did you mean \"box\"?"}},
      {"friction.coefficient=0", {"--set friction.coefficient=0: friction: coefficient = 0 is outside (0, 100]"}},
      {"restitution.coeficient=0.5", {"--set restitution.coeficient=0.5: unknown key \"coeficient\" in [restitution]"}},
      {"restitution.threshold=1", {"--set restitution.threshold=1: restitution.coefficient is missing"}},
      {"output.pictures=[\"gbl\"]", {"--set output.pictures=[\"gbl\"]: output.pictures[0] is ", "did you mean \"glb\"?"}},
      {"grain[pae].count=3", {R"(there is no grain "pae"; did you mean "pea"?)", "allowed: grain[0] to grain[1]", "pea, die"}},
      {"grain[2].count=3", {"--set grain[2].count=3: there is no grain[2]; allowed: grain[0] to grain[1]"}},
      {"grain[-1].count=3", {"there is no grain \"-1\""}},
      {"grain.count=3", {"grain is an array; allowed: grain[0] to grain[1], or instead of the number a name: pea, die"}},
      {"grian[0].count=3", {R"(the file has no array "grian"; did you mean "grain"?)"}},
      {"time.frames[0]=3", {R"(the file has no array "frames" in time; did you mean "frame"?)"}},
      {"sink.hole[0]=3", {"the file has no array \"sink\""}},
      {"time[0]=3", {"time is no array"}},
      {"seed.first=3", {"seed is no table"}},
      {"time.step=fast", {"--set time.step=fast: \"fast\" is no value of TOML; allowed: a number"}},
      {"time.step=", {"--set time.step=: \"\" is no value of TOML"}},
      {"time.step=1e-3\nframe = 1", {"is no value of TOML"}},
      {"time.step", {"--set time.step: allowed: KEY=VALUE"}},
      {"", {"allowed: KEY=VALUE"}},
      {"=1", {"allowed: KEY=VALUE"}},
      {"time..step=1", {"allowed: KEY=VALUE"}},
      {"grain[].count=1", {"allowed: KEY=VALUE"}},
      {"grain[0.count=1", {"allowed: KEY=VALUE"}},
      {"grain[0]count=1", {"allowed: KEY=VALUE"}},
  };
  for (const Wrong& mistake : mistakes) {
    CAPTURE(mistake.assignment);
    check_says(complaint(kSceneText, kCatalogueText, {mistake.assignment}), mistake.says);
  }
  const std::string twice = std::string(kSceneText) + R"([[measurement]]
kind = "fabric"
interval = 0.01
[[measurement]]
kind = "fabric"
name = "other"
interval = 0.01
[[measurement]]
kind = "coordination"
name = "fabric"
interval = 0.01
)";
  check_says(complaint(twice, kCatalogueText, {"measurement[fabric].interval=1"}),
             {"2 measurement are \"fabric\"; allowed: their numbers"});
}

TEST_CASE("what the file says wrong is told with its line, whatever is overridden") {
  check_says(complaint(replaced(kSceneText, "erp = 0.2", "erp = 2"), kCatalogueText, {"seed=1"}),
             {"scene.toml:21: solver.erp is 2"});
}
