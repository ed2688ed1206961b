// Tests of what is asked about a start from the state of another run.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "complaint.hpp"
#include "run/doubts.hpp"
#include "scene_text.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

/// A scene that starts from a state, beside the tables that its run has left.
class Continuation {
 public:
  Continuation() {
    std::filesystem::create_directory(folder_.path() / "run");
    folder_.write("grains.toml", kCatalogueText);
    table("state.csv", "grain,x_m,y_m,z_m,qw,qx,qy,qz\npea,0.02,0.02,0.003,1,0,0,0\npea,0.02,0.026,0.003,1,0,0,0\n");
  }
  void table(const char* name, const std::string& text) const { folder_.write(std::string("run/") + name, text); }
  std::vector<std::string> doubts(const std::string& sections, const std::vector<std::string>& overrides = {}) const {
    const std::string start = "[start]\nfile = \"run/state.csv\"\n";
    return doubts_about(load_scene(folder_.write("scene.toml", kSceneText + sections + start), overrides));
  }
  void check_one(const std::string& sections, const std::vector<const char*>& says) const {
    const std::vector<std::string> found = doubts(sections);
    REQUIRE(found.size() == 1);
    check_says(found[0], says);
  }

 private:
  TemporaryFolder folder_;
};

std::string bond_between(const std::string& name, const std::string& pairs) {
  return "[[bond]]\nname = \"" + name + "\"\nkind = \"ball\"\nmodulus = 1e5\n" + pairs + '\n';
}

/// A table of bonds of a run: lines of a time (s) and the section of a bond.
std::string bonds_of(const std::vector<const char*>& lines) {
  std::string text = "time_s,bond,body_1,body_2\n";
  for (const char* const line : lines) text += std::string(line) + ",0,1\n";
  return text;
}

std::string part(const std::string& shape, const std::string& rest) {
  return "[[part]]\nname = \"p\"\n" + shape + "position = [0.02, 0.03, 0.5]\naxis = [0, 0, 2]\nangle = 90\n" + rest;
}

constexpr const char* kBox = "shape = \"box\"\nsize = [0.01, 0.01, 0.01]\n";
constexpr const char* kFree = "free = { mass = 1e-4 }\n";
constexpr const char* kServo = "drive = { axis = [0, 0, -1], stress = 10, gain = 1e-4, largest_speed = 0.1, area = 1e-4 }\n";
constexpr const char* kMotion = "[[part.motion]]\nkind = \"velocity\"\nvelocity = [0, 0, -0.1]\n";
constexpr const char* kTurned = "0.70710678118654757,0,0,0.70710678118654757\n";
constexpr const char* kPoses = "time_s,part,x_m,y_m,z_m,qw,qx,qy,qz\n";

}  // namespace

TEST_CASE("continuation: bonds that are made anew beside the bonds of the run before are doubted, with the file that would do") {
  const Continuation run;
  CHECK(run.doubts(bond_between("glue", "touching = 0.1")).empty());
  run.table("broken_bonds.csv", bonds_of({"0.01,glue", "0.02,glass", "0.03,glass"}));
  const std::string file = "file = \"run/final_bonds.csv\"";
  run.table("final_bonds.csv", bonds_of({"0.1,glue"}));
  run.check_one(bond_between("glue", "touching = 0.1"),
                {"bond \"glue\" bonds the grains of start.file anew, without strain, by bond.touching: ",
                 "final_bonds.csv has 1 bond of this name with unstrained poses",
                 "bond[glue].file = \"run/final_bonds.csv\" would do (bonds.md)"});
  run.check_one(bond_between("glue", "chain = [0, 1]"), {"anew, without strain, by bond.chain: "});
  CHECK(run.doubts(bond_between("glue", file)).empty());
  CHECK(run.doubts(bond_between("glue", "touching = 0.1\n" + file)).empty());
  // All bonds of a section are broken; a section of another name is new, and those of a name that is gone are loose.
  run.check_one(bond_between("glue", file) + bond_between("glass", "touching = 10"),
                {"bond \"glass\" bonds", "all bonds of this name broke in the run before (2)"});
  CHECK(run.doubts(bond_between("glue", file) + bond_between("new", "touching = 10")).empty());
  run.check_one("", {"has 1 bond of the name \"glue\", and the scene has no section [[bond]] of this name", "bond[glue].file = "});
  run.table("final_bonds.csv", bonds_of({}));
  CHECK(run.doubts("").empty());
  run.table("final_bonds.csv", "of the user's\n");
  CHECK(run.doubts("").empty());
}

TEST_CASE("continuation: a part that does not start where the run before has left it is named, with its place") {
  for (const std::string law : {kFree, kServo, kMotion, ""}) {
    CAPTURE(law);
    const Continuation run;
    const std::string box = part(kBox, law);
    CHECK(run.doubts(box).empty());
    run.table("parts.csv", kPoses + std::string("0,p,9,9,9,1,0,0,0\n0.1,p,0.02,0.03,0.5,") + kTurned);
    CHECK(run.doubts(box).empty());
    run.table("parts.csv", kPoses + std::string("0.1,other,9,9,9,1,0,0,0\n"));
    CHECK(run.doubts(box).empty());
    run.table("parts.csv", kPoses + std::string("0.1,p,here\n"));  // a file of another form
    CHECK(run.doubts(box).empty());
    run.table("parts.csv", kPoses + std::string("0,p,0.02,0.03,0.5,") + kTurned + "0.1,p,0.02,0.03,0.40000000000000002," + kTurned);
    run.check_one(box, {"part \"p\" starts 0.1 m from where", "parts.csv leaves it",
                        "grains alone; part.position = [0.02, 0.03, 0.4] would do (start.md)"});
    run.table("parts.csv", kPoses + std::string("0.1,p,0.02,0.03,0.5,1,0,0,0\n"));
    run.check_one(box, {"starts 0.0136 m from where",  // 8.66 mm, the radius, by a right angle
                        "part.position = [0.02, 0.03, 0.5], part.axis = [1, 0, 0] and part.angle = 0 would do"});
  }
}

TEST_CASE("continuation: a plane is where its surface is") {
  const Continuation run;
  const std::string plane =
      "[[part]]\nname = \"p\"\nshape = \"plane\"\nposition = [0.02, 0.03, 0.5]\naxis = [1, 0, 0]\nangle = 180\n" +
      std::string(kServo);
  CHECK(run.doubts(plane).empty());
  run.table("parts.csv", kPoses + std::string("0.1,p,7,8,0.5,0,0,1,0\n"));  // moved along itself, and turned about its normal
  CHECK(run.doubts(plane).empty());
  run.table("parts.csv", kPoses + std::string("0.1,p,0.02,0.03,0.457,0,1,0,0\n"));
  run.check_one(plane, {"part \"p\" starts 0.043 m from where", "part.position = [0.02, 0.03, 0.457] would do"});
  run.table("parts.csv", kPoses + std::string("0.1,p,0.02,0.03,0.5,0.0099998333341666645,-0.99995000041666526,0,0\n"));
  // 78.1 mm, across the box, by 0.02.
  run.check_one(plane, {"starts 0.00156 m from where", "part.axis = [-1, 0, 0] and part.angle = 178.8541 would do"});
}

TEST_CASE("continuation: the sides of a cell are named together, with the keys that put them where they were left") {
  const Continuation run;
  const std::vector<std::string> cell = {
      R"(container={kind = "cell", width = [0.05, 0.06], height = 0.7, x_low = { drive = { force = 0, mass = 1 } }, z_high = { drive = { force = 0, mass = 1 } }})"};
  run.table("parts.csv", kPoses + std::string("0.1,x_low,0,0,0,1,0,0,0\n0.1,z_high,0,0,0.7,1,0,0,0\n"));
  const std::vector<std::string> before = run.doubts("", cell);
  run.table("parts.csv", kPoses + std::string("0.1,x_low,0.01,0,0,1,0,0,0\n0.1,z_high,0,0,0.5,1,0,0,0\n"));
  const std::vector<std::string> doubts = run.doubts("", cell);
  REQUIRE(doubts.size() == before.size() + 1);
  std::string all;
  for (const std::string& doubt : doubts) all += doubt;
  check_says(
      all, {"wall \"z_high\" starts 0.2 m from where",
            "container.corner = [0.01, 0, 0], container.width = [0.04, 0.06], container.height = 0.5 would do (start.md); the same "
            "holds for \"x_low\""});
}

TEST_CASE("continuation: a wall of the container is named without keys of a part") {
  const Continuation run;
  const std::vector<std::string> drum = {R"(container={kind = "drum", diameter = 0.1, length = 0.06, segments = 16, rpm = 30})"};
  run.table("state.csv", "grain,x_m,y_m,z_m,qw,qx,qy,qz\npea,0,0.02,0.0035,1,0,0,0\n");
  const auto starts = [](const std::vector<std::string>& doubts) {
    std::string all;
    for (const std::string& doubt : doubts) {
      if (doubt.find("starts") != std::string::npos) all += doubt;
    }
    return all;
  };
  run.table("parts.csv", kPoses + std::string("0.1,drum,0,0,0.05,1,0,0,0\n"));
  CHECK(starts(run.doubts("", drum)).empty());
  run.table("parts.csv", kPoses + std::string("0.1,drum,0,0,0.05,0.70710678118654757,0,0.70710678118654757,0\n"));
  check_says(starts(run.doubts("", drum)), {"wall \"drum\" starts", "keys of [container]", "(start.md)"});
}
