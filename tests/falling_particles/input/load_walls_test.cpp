// Tests of the [[part]] sections of scene files: what they may say, and what is said of mistakes.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include "common/mesh.hpp"
#include "scenes.hpp"

using namespace falling_particles;

namespace {

constexpr const char* kPart = R"(
[[part]]
name = "plate"
shape = "box"
size = [0.1, 0.2, 0.02]
position = [0, 0, 0.5]
axis = [0, 0, 2]
angle = 90
[[part.motion]]
kind = "vibration"
direction = [0, 0, 3]
amplitude = 0.001
frequency = 50
phase = 90
from = 0.01
until = 0.05
[[part.motion]]
kind = "rotation"
axis = [0, 1, 0]
point = [0, 0, 1]
rpm = 30
[part.drive]
axis = [0, 0, -1]
pressure = 1000
mass = 0.2
travel = [0, 0.3]
)";

constexpr const char* kNone = R"(kind = "none"
start = {corner = [0, 0, 0], size = [0.05, 0.06, 0.2]}
bounds = {corner = [-0.1, -0.1, -0.1], size = [0.3, 0.3, 0.4]})";

std::string with_part(const std::string& part = kPart) {
  std::string text = kSceneText;
  text += part;
  return text;
}

constexpr const char* kTetrahedron = R"(solid t
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 10 0
vertex 10 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 10 0 0
vertex 0 0 10
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 10
vertex 0 10 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 10 0 0
vertex 0 10 0
vertex 0 0 10
endloop
endfacet
endsolid t
)";

}  // namespace

TEST_CASE("the values of a part are read") {
  const Scene scene = scene_of(with_part());
  REQUIRE(scene.parts().size() == 1);
  const Wall& wall = scene.parts()[0];
  CHECK(wall.name == "plate");
  CHECK(std::get<BoxShape>(wall.shape).size == Vector3(0.1, 0.2, 0.02));
  CHECK((wall.start(Vector3::UnitX()) - Vector3(0, 1, 0.5)).norm() < 1e-15);
  REQUIRE(wall.motions.size() == 2);
  const auto& vibration = std::get<Vibration>(wall.motions[0].kind);
  CHECK(vibration.amplitude == Vector3(0, 0, 0.001));
  CHECK(wall.motions[0].until == 0.05);
  CHECK(std::get<Rotation>(wall.motions[1].kind).rpm == 30);
  REQUIRE(wall.drive);
  CHECK(wall.drive->force ==
        doctest::Approx(1000 * 0.1 * 0.2));  // the area that a box shows along z, however it is turned about it
  CHECK(wall.drive->travel[1] == 0.3);
}

TEST_CASE("the error of a part names the key, its value and the allowed values") {
  const std::vector<Mistake> mistakes = {
      {"shape = \"box\"", "shape = \"bx\"", {"part.shape is \"bx\"", "did you mean \"box\"", "superovoid"}},
      {"name = \"plate\"", "name = \"a, b\"", {"part.name is \"a, b\"", "letters, digits"}},
      {"size = [0.1, 0.2, 0.02]", "size = [0.1, -0.2, 0.02]", {"part.size[1] is -0.2", "(0, 1000] m"}},
      {"size = [0.1, 0.2, 0.02]", "radius = 1\nsize = [1, 1, 1]", {"unknown key \"radius\"", "size"}},
      {"axis = [0, 0, 2]", "axis = [0, 0, 0]", {"part.axis is [0, 0, 0]", "a direction"}},
      {"axis = [0, 0, 2]", "", {"part.axis is missing"}},
      {"kind = \"vibration\"", "kind = \"shake\"", {"part.motion.kind is \"shake\"", "conveyor"}},
      {"frequency = 50", "frequency = 500", {"part.motion.frequency is 500", "(0, 200] Hz", "ten time.step"}},
      {"amplitude = 0.001", "amplitude = 0", {"part.motion.amplitude is 0", "(0, 1000] m"}},
      {"until = 0.05", "until = 0.01", {"part.motion.until is 0.01", "after from"}},
      {"rpm = 30", "rpm = 30000", {"part.motion.rpm is 30000", "[-12000, 12000]", "tenth"}},
      {"rpm = 30", "rpm = 30\nfrequency = 1", {"unknown key \"frequency\""}},
      {"pressure = 1000", "", {"part.drive.force is missing", "one of force, pressure, torque, power, stress"}},
      {"pressure = 1000", "pressure = 1\nforce = 1", {"part.drive has both force and pressure", "one of force"}},
      {"pressure = 1000", "force = 1\npoint = [0, 0, 0]", {"unknown key \"point\"", "force, mass, damping"}},
      {"pressure = 1000", "power = 1", {"part.drive.largest_force is missing", "(0, 1e+09] N, at rest"}},
      {"pressure = 1000", "power = -1\nlargest_force = 1", {"part.drive.power is -1", "(0, 1e+09] W"}},
      {"mass = 0.2", "mass = 0", {"part.drive.mass is 0", "kg"}},
      {"travel = [0, 0.3]", "travel = [0.1, 0.3]", {"part.drive.travel is [0.1, 0.3]", "0 or less"}},
  };
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.to);
    check_says(complaint(replaced(with_part(), mistake.from, mistake.to)), mistake.says);
  }
  check_says(complaint(with_part(std::string(kPart) + kPart)), {"part.name is \"plate\"", "another part"});
  check_says(complaint(replaced(with_part(), "\"plate\"", "\"x_low\"")),
             {"part.name is \"x_low\"", "a wall of the container has; allowed: a name of its own"});
  check_says(complaint(scene_in("kind = \"periodic\"\nside = 0.1") + kPart), {"part in a periodic container"});
}

TEST_CASE("a part that turns has a point, a moment and a travel in degrees") {
  const std::string door = replaced(kPart, "pressure = 1000\nmass = 0.2\ntravel = [0, 0.3]",
                                    "torque = 2\npoint = [0.1, 0, 0]\nmoment = 0.3\ntravel = [-90, 60]\n");
  const Drive drive = *scene_of(with_part(door)).parts()[0].drive;
  CHECK(drive.turns());
  CHECK(drive.force == 2);
  CHECK(drive.mass == 0.3);
  CHECK(drive.travel[0] == doctest::Approx(-1.5707963268));
  const Wall motor = scene_of(with_part(replaced(door, "torque = 2", "power = 5\nlargest_torque = 7\nmass = 0.4"))).parts()[0];
  CHECK(motor.drive->power == 5);
  CHECK(motor.drive->force == 7);
  CHECK(motor.drive->hung_mass == 0.4);
  const std::vector<Mistake> mistakes = {
      {"point = [0.1, 0, 0]", "", {"part.drive.point is missing", "m, on its axis"}},
      {"moment = 0.3", "moment = 0", {"part.drive.moment is 0", "kg m^2"}},
      {"moment = 0.3", "mass = 0.3", {"part.drive.moment is missing"}},
      {"[-90, 60]", "[-90, 180]", {"part.drive.travel[1] is 180", "[-170, 170] degrees"}},
      {"torque = 2", "power = 5", {"part.drive.largest_torque is missing", "N m, at rest"}},
      {"torque = 2", "torque = 2\nforce = 1", {"part.drive has both force and torque"}},
  };
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.to);
    check_says(complaint(with_part(replaced(door, mistake.from, mistake.to))), mistake.says);
  }
}

TEST_CASE("a servo has an area, its own or that between four walls that face each other") {
  const std::string lid =
      "[[part]]\nname = \"lid\"\nshape = \"plane\"\nposition = [0, 0, 0.3]\naxis = [1, 0, 0]\nangle = 180\n[part.drive]\n"
      "axis = [0, 0, -1]\nstress = 1000\ngain = 1e-5\nlargest_speed = 0.1\nbetween = [\"x_low\", \"x_high\", \"y_low\", "
      "\"y_high\"]\n";
  const Servo servo = *scene_of(with_part(lid)).walls.back().drive->servo;
  CHECK(servo.stress == 1000);
  CHECK(servo.gain == 1e-5);
  CHECK(servo.largest_speed == 0.1);
  CHECK(servo.between == std::vector<FacingWalls>{{"x_low", "x_high"}, {"y_low", "y_high"}});
  const std::string between = R"(between = ["x_low", "x_high", "y_low", "y_high"])";
  CHECK(scene_of(with_part(replaced(lid, between, "area = 0.02"))).walls.back().drive->servo->area == 0.02);
  const std::vector<Mistake> mistakes = {
      {"stress = 1000", "stress = -1", {"part.drive.stress is -1", "(0, 1e+09] Pa"}},
      {"gain = 1e-5", "", {"part.drive.gain is missing", "m/(s Pa)"}},
      {"gain = 1e-5", "gain = 0", {"part.drive.gain is 0", "m/(s Pa)"}},
      {"largest_speed = 0.1", "largest_speed = 0", {"part.drive.largest_speed is 0", "(0, 1000] m/s"}},
      {"stress = 1000", "stress = 1000\nmass = 1", {"unknown key \"mass\"", "gain"}},
      {"stress = 1000", "stress = 1000\narea = 1", {"unknown key \"area\"", "between"}},
      {"\"x_high\"", "\"x_hig\"", {"part.drive.between[1] is the string \"x_hig\"", "did you mean \"x_high\""}},
      {R"(, "y_low", "y_high")", "", {"part.drive.between has 2 walls", "2 pairs of planes or boxes"}},
      {R"("y_low", "y_high")", R"("floor", "lid")", {R"(has "floor" and "lid", which are no such pair)", "the axis of the drive"}},
      {R"("x_high", "y_low")", R"("y_low", "x_high")", {R"(has "x_low" and "y_low", which are no such pair)"}},
  };
  for (const Mistake& mistake : mistakes) {
    CAPTURE(mistake.to);
    check_says(complaint(with_part(replaced(lid, mistake.from, mistake.to))), mistake.says);
  }
  check_says(complaint(with_part(replaced(lid, between, ""))), {"part.drive.area is missing", "m^2"});
  // Walls that the scene loses along a periodic axis are no walls.
  check_says(complaint(with_part(lid + "[periodic]\nx = [0, 0.05]\n")), {"part.drive.between[0] is the string \"x_low\""});
}

TEST_CASE("a conveyor needs a velocity or a turn, and no drive") {
  const std::string belt = "[[part]]\nname = \"belt\"\nshape = \"plane\"\n[[part.motion]]\nkind = \"conveyor\"\n";
  check_says(complaint(with_part(belt)), {"part.motion.velocity is missing", "or axis, point and rpm"});
  check_says(complaint(with_part(belt + "axis = [0, 0, 1]\n")), {"part.motion.point is missing"});
  CHECK(complaint(with_part(belt + "velocity = [1, 0, 0]\n")).empty());
  const std::string drive = "[part.drive]\naxis = [0, 0, 1]\nforce = 1\nmass = 1\n";
  check_says(complaint(with_part(belt + "velocity = [1, 0, 0]\n" + drive)), {"part.drive besides", "conveyor"});
}

TEST_CASE("a superovoid that is not convex is refused") {
  const std::string part = "[[part]]\nname = \"egg\"\nshape = \"superovoid\"\nhalf_axes = [1, 1, 1]\ndelta = 2\nepsilon = 2\n";
  check_says(complaint(with_part(part + "taper = [0.9, 0.9]\n")), {"part.taper", "taper"});
  CHECK(complaint(with_part(part + "taper = [0.3, 0.3]\n")).empty());
}

TEST_CASE("a pressure on a shape without a projected area needs `area`") {
  const std::string part =
      "[[part]]\nname = \"lid\"\nshape = \"plane\"\n[part.drive]\naxis = [0, 0, -1]\npressure = 100\nmass = 1\n";
  check_says(complaint(with_part(part)), {"part.drive.area is missing", "m^2"});
  CHECK(scene_of(with_part(part + "area = 0.02\n")).walls.back().drive->force == doctest::Approx(2));
}

TEST_CASE("a container of kind none has a start and bounds, and parts hold the grains") {
  const Scene scene = scene_of(scene_in(kNone) + kPart);
  CHECK(contains(scene.container, {0, 0, -0.05}));
  CHECK_FALSE(contains(scene.container, {0, 0, -0.2}));
  check_says(complaint(scene_in(kNone)), {"container.kind is \"none\" in a scene without parts", "[[part]]"});
  check_says(complaint(replaced(scene_in(kNone), "size = [0.05, 0.06, 0.2]", "size = [0.05, 0.06, 0.4]") + kPart),
             {"container.start reaches from 0 to 0.4 m along z", "within container.bounds"});
  // A layer has 2 by 3 cells.
  check_says(complaint(replaced(scene_in(kNone), "size = [0.05, 0.06, 0.2]", "size = [0.05, 0.06, 0.04]") + kPart),
             {"container.start.size[2] is 0.04 m, with room for 6 of the scene's 7 grains"});
}

TEST_CASE("a mesh is read in its unit, and a bad file is refused with the reason") {
  if (!can_load_meshes()) return;
  const TemporaryFolder folder;
  folder.write("grains.toml", kCatalogueText);
  folder.write("t.stl", kTetrahedron);
  folder.write("broken.stl", "");
  folder.write("nan.stl", replaced(kTetrahedron, "endfacet\nendsolid t",
                                   "endfacet\nfacet normal 0 0 1\nouter loop\nvertex nan 0 0\n"
                                   "vertex 1 nan 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t"));
  folder.write("twice.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 2 1 3\n");
  folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
  folder.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const auto load = [&](const std::string& file, const std::string& unit) {
    return load_scene(folder.write(
        "scene.toml", with_part("[[part]]\nname = \"m\"\nshape = \"mesh\"\nfile = \"" + file + "\"\nunit = \"" + unit + "\"\n")));
  };
  const auto refusal = [&](const std::string& file, const std::string& unit) -> std::string {
    return refusal_by([&] { load(file, unit); });
  };
  const auto mesh = std::get<MeshShape>(load("t.stl", "mm").walls.back().shape);
  CHECK(mesh.vertices.size() == 4);
  CHECK(mesh.triangles.size() == 4);
  CHECK(bounding_radius(mesh) == doctest::Approx(0.01));
  CHECK(std::get<MeshShape>(load("square.obj", "inch").walls.back().shape).triangles.size() == 2);
  // An OBJ that names a file of materials is read as without it: lines of the file would be quoted in warnings.
  folder.write("secret", "newmtl a\nmap_Kd secret\nroot:$6$hash:19000:0:99999:7:::\n");
  for (const std::string& named :
       {folder.path().string() + "/secret", std::string("secret"), std::string("../secret"), std::string("pipe.stl")}) {
    folder.write("named.obj", "mtllib " + named + "\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    REQUIRE(mkfifo((folder.path() / "pipe.stl").c_str(), 0600) == 0);
    CHECK(std::get<MeshShape>(load("named.obj", "inch").walls.back().shape).triangles.size() == 2);
    check_says(refusal("pipe.stl", "mm"), {"part.file", "pipe.stl\" is a pipe or a socket, and no file"});
    std::filesystem::remove(folder.path() / "pipe.stl");
  }
  check_says(refusal("none.stl", "mm"), {"part.file", "there is no file", "none.stl"});
  check_says(refusal("points.obj", "mm"), {"part.file", "points.obj"});
  check_says(refusal("broken.stl", "mm"), {"part.file", "broken.stl", "cannot be read"});
  check_says(refusal("nan.stl", "mm"), {"part.file", "nan.stl\" has a coordinate that is not finite"});
  check_says(refusal("twice.obj", "m"),
             {"part.file: \"twice.obj\" has 1 triangle with corners in both orders", "part.two_sided = true"});
  const auto sheet = std::get<MeshShape>(load("twice.obj", "m\"\ntwo_sided = true # ").walls.back().shape);
  CHECK(sheet.two_sided);
  CHECK(sheet.triangles.size() == 1);
  check_says(refusal("t.step", "mm"), {"part.file is \"t.step\"", ".stl or .obj"});
  check_says(refusal("t.stl", "ft"), {"part.unit is \"ft\"", "inch"});
}

TEST_CASE("a part with a coefficient that an effect of the scene excludes is refused with its line") {
  const std::string part = "[[part]]\nname = \"p\"\nshape = \"box\"\nsize = [0.01, 0.01, 0.01]\nposition = [0.02, 0.02, 0.5]\n";
  const std::string soft = replaced(kSceneText, "[max_correcting_velocity]\nvelocity = 0.05\n", "[compliance]\nstiffness = 1e4\n");
  check_says(complaint(soft + part + "restitution = 0.5\n"),
             {"scene.toml:36: part.restitution besides an effect of the scene: compliance must be without restitution",
              "allowed: a wall without it"});
  CHECK(complaint(soft + part + "friction = 0.5\n").empty());
}
