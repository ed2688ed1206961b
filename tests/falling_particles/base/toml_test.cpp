// TOML: values given on the command line, the depth of nesting, and texts as strings.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "base/toml_input.hpp"
#include "base/toml_override.hpp"
#include "common/toml_string.hpp"
#include "scenes.hpp"
#include "support/temporary_folder.hpp"

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

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

std::string read_back(const std::string& text) {
  const TemporaryFolder folder;
  return TomlFile(folder.write("file.toml", "key = " + toml_string(text) + " # comment\n"), "file").root({"key"}).text("key");
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

TEST_CASE("toml depth: levels by dots, headers, arrays and tables are counted, each alone and all together") {
  struct Kind {
    std::string open, inner, close;
  };
  const std::array kinds = {Kind{"a.", "a = 1", ""},          Kind{"\"a b\" . ", "a = 1", ""}, Kind{"'a'.", "a = 1", ""},
                            Kind{"x = [", "1", "]"},          Kind{"x = {a = ", "1", "}"},     Kind{"x = {a = [ # [\n", "1", "]}"},
                            Kind{"x = [{a.b = ", "1.5", "}]"}};
  for (const Kind& kind : kinds) {
    CAPTURE(kind.open);
    const auto nested = [&](std::size_t levels) {
      const std::size_t equal = kind.open.find("= ");
      const std::string again = equal == std::string::npos ? kind.open : kind.open.substr(equal + 2);
      return kind.open + repeated(again, levels - 1) + kind.inner + repeated(kind.close, levels);
    };
    CHECK_FALSE(find_deep_toml(nested(20)));
    CHECK(find_deep_toml("\n\n" + nested(kMostTomlLevels + 1)).value_or(0) >= 3);
    CHECK(find_deep_toml(nested(50'000)));
  }
  CHECK(find_deep_toml("[a" + repeated(".a", 50'000) + "]") == 1U);
  CHECK(find_deep_toml("[[a" + repeated(".a", 50'000) + "]]") == 1U);
}

TEST_CASE("toml depth: what is no level is not counted") {
  const std::string many = repeated(".[{", 1000);
  for (const std::string& text : {"# " + many, R"(a = ")" + many + R"(")", "a = '" + many + "'", R"(a = "\")" + many + R"(")",
                                  "a = \"\"\"\n" + many + "\"\n\"\"\"", "a = '''\n" + many + "'\n'''",
                                  "a = [" + repeated("1.5, ", 1000) + "]", "a = [" + repeated("[1.5, 2.5], # [\n", 1000) + "]",
                                  repeated("a.b = 1.5\n", 1000), repeated("[[a.b]]\nc = {d.e = [1.5]}\n", 1000)}) {
    CAPTURE(text.substr(0, 30));
    CHECK_FALSE(find_deep_toml(text));
  }
  CHECK(find_deep_toml("a = \"\"\"\n\n\"\"\"\n" + repeated("b.", 200)) == 4U);
  for (const char* torn : {R"(")", "'", R"(""")", R"(a = "\)", "[", "]]]]", "#"}) CHECK_FALSE(find_deep_toml(torn));
}

TEST_CASE("toml depth: a scene, a catalogue and an override of many levels are refused before they are parsed") {
  const std::string deep = repeated("a.", 50'000) + "a = 1\n";
  check_says(complaint(deep + kSceneText),
             {"scene.toml:1: keys, arrays or tables are nested in more than 100 levels; allowed: up to 100"});
  check_says(complaint(kSceneText, deep), {"grains.toml:1: keys, arrays or tables are nested"});
  for (const std::string& text : {repeated("a.", 50'000) + "a=1", "a=" + repeated("[", 50'000), "a={" + deep + "}"}) {
    const std::string said = complaint(kSceneText, kCatalogueText, {text.substr(0, text.find('\n'))});
    check_says(said, {"nested in more than 100 levels"});
    CHECK(said.size() < 250);
  }
}

TEST_CASE("a pipe, a device and a folder in the place of a file are named, and not waited for") {
  const TemporaryFolder folder;
  const std::string pipe = (folder.path() / "pipe.toml").string();
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  const auto refusal = [](const std::string& path) { return refusal_by([&] { falling_particles::load_scene(path); }); };
  check_says(refusal(pipe), {"cannot read scene file", "pipe.toml\": it is a pipe or a socket; allowed: a file"});
  check_says(refusal("/dev/zero"), {"\"/dev/zero\": it is a device; allowed: a file"});
  check_says(refusal(folder.path().string()), {"it is a folder; allowed: a file"});
  std::string text = kSceneText;
  const std::string path = folder.write("scene.toml", text.replace(text.find("grains.toml"), 11, "pipe.toml"));
  check_says(refusal(path), {"catalogue: \"", "pipe.toml\" is a pipe or a socket; allowed: a grain catalogue"});
}

TEST_CASE("strings are written so that they read back") {
  for (const std::string text : {"plain", "with \"quotes\"", "C:\\grains\\new", "it's", "'''", "line\nfeed", "tab\t", "\x01\x7f",
                                 "Schüttgut", "# no comment", "]"}) {
    CAPTURE(text);
    CHECK(read_back(text) == text);
    CHECK(toml_string(text).find('\n') == std::string::npos);
  }
  CHECK(toml_string("plain") == "\"plain\"");
  CHECK(read_back("Latin-1: \xfc") == "Latin-1: ü");
}
