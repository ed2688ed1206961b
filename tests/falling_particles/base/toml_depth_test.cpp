#include "base/toml_depth.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include <array>
#include <string>

#include "complaint.hpp"

using falling_particles::find_deep_toml;
using falling_particles::kMostTomlLevels;

namespace {

std::string repeated(const std::string& text, std::size_t times) {
  std::string all;
  for (std::size_t i = 0; i < times; ++i) all += text;
  return all;
}

}  // namespace

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
