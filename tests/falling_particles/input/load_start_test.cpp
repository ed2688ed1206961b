// The section [start]: the grains of a scene from a file.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "advise/refusals.hpp"
#include "common/input_error.hpp"
#include "model/grain_shape.hpp"
#include "scenes.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

constexpr const char* kOneGrain =
    "grain,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s\n"
    "die, 0.02, 0.03, 0.01, 0.7071, 0, 0.7071, 0, 0.1, 0, -0.2, 0, 5, 0\n";

constexpr const char* kDump = R"(ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
1
ITEM: BOX BOUNDS ff ff ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z c_shape[1] c_shape[2] c_shape[3] c_shape[4] c_shape[5] c_shape[6] c_shape[7]
1 1 9 9 9 9 9 9 9 9 9 9
ITEM: TIMESTEP
100
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS ff ff ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z c_shape[1] c_shape[2] c_shape[3] c_shape[4] c_shape[5] c_shape[6] c_shape[7] fx
7 2 0.02 0.03 0.01 0.012 0.012 0.012 0 0 0.6 0.8 1e9
3 1 0.04 0.03 0.01 0.00600001 0.006 0.006 0 0 0 1 0
)";

/// Loads the scene with a state, a file beside it. Without an error, `text` is empty.
struct Loaded {
  Loaded(const std::string& state, std::vector<std::string> overrides = {}) {
    const TemporaryFolder folder;
    folder.write("grains.toml", kCatalogueText);
    folder.write("state", state);
    const std::string path = folder.write("scene.toml", kSceneText);
    overrides.insert(overrides.begin(), "start.file=\"state\"");
    text = without_folder(refusal_by([&] { scene = load_scene(path, overrides); }), folder);
  }
  Scene scene{};
  std::string text;
};

/// Loads the scene with a free brick "lid" and a table of parts.
Loaded with_parts(const std::string& rows) {
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  folder.write("state", kOneGrain);
  folder.write("parts.csv",
               "time_s,part,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,wz_rad_per_s,"
               "travel\n" +
                   rows);
  const std::string brick =
      "[[part]]\nname = \"lid\"\nshape = \"box\"\nsize = [0.01, 0.01, 0.01]\nposition = [0, 0, 1]\n"
      "[part.free]\nmass = 0.001\n";
  const std::string path = folder.write("scene.toml", kSceneText + brick);
  Loaded loaded(kOneGrain);
  loaded.text =
      without_folder(refusal_by([&] { loaded.scene = load_scene(path, {R"(start={file="state",parts="parts.csv"})"}); }), folder);
  return loaded;
}

const std::vector<StartGrain>& grains_of(const Loaded& loaded) {
  CAPTURE(loaded.text);
  REQUIRE(loaded.scene.start.has_value());
  return loaded.scene.start->grains;
}

}  // namespace

TEST_CASE("start.parts: a part starts where the last frame of a table of parts has it, with its velocity") {
  const Loaded loaded = with_parts(
      "0,lid,9,9,9,1,0,0,0,9,9,9,9,9,9,\n1,other,8,8,8,1,0,0,0,8,8,8,8,8,8,\n"
      "1,lid,0.1,0.2,0.3,0.6,0,0,0.8,1,2,3,4,5,6,0.5\n");
  REQUIRE(loaded.text.empty());
  const Wall& lid = loaded.scene.walls.back();
  CHECK(lid.start.position == Vector3(0.1, 0.2, 0.3));
  CHECK(lid.start.rotation.w() == 0.6);
  CHECK(lid.start.rotation.z() == 0.8);
  CHECK(lid.flight->velocity.linear == Vector3(1, 2, 3));
  CHECK(lid.flight->velocity.angular == Vector3(4, 5, 6));
  CHECK(loaded.scene.files.size() == 4);
  check_says(with_parts("0,lod,9,9,9,1,0,0,0,9,9,9,9,9,9,\n").text, {"start.parts", "names no part of the scene"});
  check_says(with_parts("0,lid,9,9,9,1,1,0,0,9,9,9,9,9,9,\n").text, {"parts.csv:2", "a quaternion of norm"});
}

TEST_CASE("start: a CSV file of one grain has its kind, pose and velocities, whatever the counts of the scene") {
  const Loaded loaded(kOneGrain);
  REQUIRE(grains_of(loaded).size() == 1);
  const StartGrain& grain = grains_of(loaded)[0];
  CHECK(grain.kind == 1);
  CHECK(grain.scale == 1);
  CHECK(grain.position == Point{0.02, 0.03, 0.01});
  CHECK(grain.quaternion == std::array<double, 4>{0.7071, 0, 0.7071, 0});
  CHECK(grain.velocity == Point{0.1, 0, -0.2});
  CHECK(grain.angular_velocity == Point{0, 5, 0});
  CHECK(loaded.scene.kinds[0].count == 0);
  CHECK(loaded.scene.kinds[1].count == 1);
  CHECK(loaded.scene.start->has_velocities);
  CHECK(loaded.scene.files.back().filename() == "state");  // its bytes belong to the identity of a run
}

TEST_CASE("start: a byte order mark, as spreadsheets write, is no part of the first column") {
  const Loaded marked(std::string("\xEF\xBB\xBF") + kOneGrain);
  CHECK(marked.text.empty());
  REQUIRE(marked.scene.start);
  CHECK(marked.scene.start->grains.front().position == Loaded(kOneGrain).scene.start->grains.front().position);
}

TEST_CASE("start: of a trajectory, the last frame is read, and its grains are at rest") {
  const Loaded loaded(
      "time_s,body,grain,x_m,y_m,z_m,qw,qx,qy,qz\n0,0,pea,9,9,9,1,0,0,0\n0,1,pea,9,9,9,1,0,0,0\n"
      "0.1,1,pea,0.01,0.02,0.03,1,0,0,0\n0.1,0,die,0.03,0.02,0.01,1,0,0,0\n");
  REQUIRE(grains_of(loaded).size() == 2);
  CHECK(grains_of(loaded)[0].kind == 1);  // in the order of `body`
  CHECK(grains_of(loaded)[1].position == Point{0.01, 0.02, 0.03});
  CHECK(loaded.scene.start->time == 0.1);
  CHECK(!loaded.scene.start->has_velocities);
}

TEST_CASE("start: a dump of LAMMPS names kinds by their types, in the order of its ids") {
  const Loaded loaded(kDump);
  REQUIRE(grains_of(loaded).size() == 2);
  CHECK(grains_of(loaded)[0].kind == 0);
  CHECK(grains_of(loaded)[0].scale == 1);  // to the six digits of a dump
  CHECK(grains_of(loaded)[1].quaternion == std::array<double, 4>{0.8, 0, 0, 0.6});
}

TEST_CASE("start: an angular momentum in a dump becomes an angular velocity about the axes of the grain") {
  std::string dump = kDump;
  dump = replaced(dump, "c_shape[7] fx", "c_shape[7] angmomx angmomy angmomz");
  dump = replaced(dump, "0.6 0.8 1e9", "0.6 0.8 0 0 1e-6");
  dump = replaced(dump, "0 0 0 1 0\n", "0 0 0 1 0 0 0\n");
  const Loaded loaded(dump);
  const StartGrain& die = grains_of(loaded)[1];
  const double inertia = lammps_inertia(loaded.scene.kinds[1].kind, 1, die.quaternion)(2, 2);
  CHECK(die.angular_velocity[2] == doctest::Approx(1e-6 / inertia).epsilon(1e-12));
  CHECK(std::abs(die.angular_velocity[0]) < 1e-12);
  // A cube of density rho and edge a has rho a^5 / 6; this one is rounded at its edges.
  const double cube = 1190 * std::pow(0.012, 5) / 6;
  CHECK(inertia < cube);
  CHECK(inertia > 0.7 * cube);
}

TEST_CASE("start: sizes must be in the range of the kind") {
  const std::string grain = "grain,scale,x_m,y_m,z_m,qw,qx,qy,qz\npea,1.5,0.02,0.03,0.01,1,0,0,0\n";
  const std::string size = R"(grain[pea].size={distribution = "uniform", unit = "catalogue", smallest = 0.5, largest = 2})";
  const Loaded loaded(grain, {size});
  CHECK(grains_of(loaded)[0].scale == 1.5);
  CHECK(loaded.scene.kinds[0].scales == std::vector<double>{1.5});
  CHECK(loaded.scene.smallest_half_axis() ==
        doctest::Approx(4.5e-3).epsilon(1e-12));  // of the grains that are there: a pea has 3 mm, a die 6 mm
  check_says(Loaded(grain).text, {"state:2: grain \"pea\" has 1.5 of the size of the catalogue; allowed: 1"});
  check_says(Loaded(replaced(grain, "1.5", "2.1"), {size}).text, {"state:2: ", "has 2.1 of", "allowed: 0.5 to 2"});
  check_says(Loaded(kOneGrain, {size}).text, {"state:1: column scale is missing, which grain \"pea\" with sizes needs"});
}

TEST_CASE("start: mistakes in a CSV file are refused with line and column") {
  const std::vector<Mistake> mistakes = {
      {"die, 0.02", "dice, 0.02", {"state:2: grain is \"dice\"", "did you mean \"die\"", "allowed (the scene's): pea, die"}},
      {"0.02,", "nan,", {"state:2: x_m is \"nan\"; allowed: a number in [-1000, 1000] m"}},
      {"0.02,", "2 cm,", {"state:2: x_m is \"2 cm\""}},
      {"0.02,", "1e4,", {"state:2: x_m is \"1e4\"; allowed: a number in [-1000, 1000] m"}},
      {" 5, 0", " inf, 0", {"state:2: wy_rad_per_s is \"inf\"; allowed: a number in [-1e+06, 1e+06] rad/s"}},
      {"0.01, 0.7071", "0.01, 0.8", {"state:2: qw, qx, qy, qz are a quaternion of norm 1.07; allowed: 1"}},
      {"-0.2, 0", "-0.2", {"state:2: the line has 13 fields; allowed: 14, as line 1 has columns, separated by commas"}},
      {"qw,", "q0,", {"state:1: unknown column \"q0\"", "allowed: time_s, body, grain, scale, x_m"}},
      {"grain,x_m,", "grain,y_m,", {"state:1: column \"y_m\" occurs twice"}},
      {"vz_m_per_s,", "scale,", {"state:1: column vz_m_per_s is missing"}},
      {"grain,x_m", "body,x_m", {"state:1: column grain is missing"}},
  };
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.to);
    check_says(Loaded(replaced(kOneGrain, mistake.from, mistake.to)).text, mistake.says);
  }
  const std::string head = "body,grain,x_m,y_m,z_m,qw,qx,qy,qz\n4,pea,0.01,0.01,0.01,1,0,0,0\n";
  check_says(Loaded(head + "4,pea,0.02,0.02,0.02,1,0,0,0\n").text, {"state:3: body is 4, which another line has"});
  check_says(Loaded("grain,x_m,y_m,z_m,qw,qx,qy,qz\n").text, {"state:1: the file has only its head, or nothing"});
  check_says(Loaded("").text, {"state:1: the file has only its head, or nothing"});
  check_says(Loaded("grain,x,y,z\npea,0,0,0\n").text, {R"(state:1: unknown column "x"; did you mean "x_m"?)"});
  check_says(Loaded("grain;x_m;y_m\npea;0,1;0,2\n").text,
             {"state:1: the line with the names of the columns is \"grain;x_m;y_m\", without a comma",
              "allowed: columns separated by commas"});
  check_says(Loaded("grain,x_m,y_m\npea;0;0\n").text, {"state:2: the line has 1 field; allowed: 3", "separated by commas"});
}

TEST_CASE("start: mistakes in a dump are refused") {
  const std::vector<Mistake> mistakes = {
      {"7 2 0.02", "7 3 0.02", {"state:20: type is \"3\"; allowed: a whole number from 1 to 2"}},
      {"7 2 0.02", "7 1 0.02", {"state:20: grain \"pea\" has 2 of the size of the catalogue; allowed: 1"}},
      {"0.012 0.012 0.012 0", "0.012 0.012 0.013 0", {"state:20: shapez is 0.013 m; allowed: 0.012 m beside shapex = 0.012 m"}},
      {"3 1 0.04", "7 1 0.04", {"state:21: body is 7, which another line has"}},
      {"ATOMS\n2", "ATOMS\n3", {"state:21: the frame ends after 2 of 3 atoms"}},
      {"c_shape[7] fx", "stress fx", {"state:19: column qw is missing"}},
      {"c_shape[7] fx", "c_shape[7] vx", {"state:19: column vy_m_per_s is missing"}},
  };
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.to);
    check_says(Loaded(replaced(kDump, mistake.from, mistake.to)).text, mistake.says);
  }
  check_says(Loaded("ITEM: UNITS\nlj\n" + std::string(kDump)).text, {"state:2: the units of the dump are \"lj\"; allowed: si"});
}

TEST_CASE("start: a scene with a state needs no counts and no lattice") {
  std::string text = replaced(kSceneText, "[drop]\nheight = 0.01\ngap = 0.1\n", "[start]\nfile = \"none.csv\"\n");
  text = replaced(replaced(text, "count = 5\n", ""), "count = 2\n", "");
  check_says(complaint(text), {"scene.toml:", "start.file: there is no file \"none.csv\"", "allowed: final_state.csv"});
  check_says(complaint(replaced(text, "file = \"none.csv\"", "overlap = 2")), {"start.overlap is 2; allowed: a number in (0, 1]"});
  check_says(complaint(replaced(text, "file = \"none.csv\"", "folder = 2")), {"unknown key \"folder\""});
  const Loaded narrow(kOneGrain, {"container.width=[0.01, 0.06]"});  // on a lattice, the die would not fit in any orientation
  CHECK(narrow.text.empty());
}

TEST_CASE("start: the outlet of a hopper may be open from the start") {
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  folder.write("state", "grain,x_m,y_m,z_m,qw,qx,qy,qz\npea,0,0,0.03,1,0,0,0\npea,0,0,0.07,1,0,0,0\n");
  const std::string open = replaced(kHopperText, "opens_at = 0.05", "opens_at = 0");
  const Scene scene = load_scene(folder.write("scene.toml", scene_in(open) + "[start]\nfile = \"state\"\n"));
  refuse_bad_start(scene);  // it would find the grain below in a lid
  CHECK(scene.start->grains.size() == 2);
}
