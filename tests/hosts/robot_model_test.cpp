// Tests of samples/hosts/robot_model: masses, rests and messages of SDF and URDF files.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/refusal.hpp"
#include "support/relative.hpp"
#include "support/temporary_folder.hpp"
#include "world.hpp"

namespace {

using namespace robot_model;
using supernormal::test::relative;

constexpr double kPi = std::numbers::pi;

const std::string kFolder = ROBOT_MODEL_FOLDER;

Scene scene_of(const std::string& text, const std::string& name, bool strict = true) {
  const TemporaryFolder folder;
  return read_scene(folder.write(name, text), strict);
}

std::string sdf(const std::string& models) {
  return "<sdf version='1.9' xmlns:supernormal='urn:supernormal'><world name='w'>" + models + "</world></sdf>";
}

std::string model_of(const std::string& name, const std::string& content) {
  return "<model name='" + name + "'>" + content + "</model>";
}

/// A world with one model.
std::string sdf_of(const std::string& content) { return sdf(model_of("m", content)); }

std::string link_of(const std::string& geometry, const std::string& rest = "", const std::string& name = "l") {
  return "<link name='" + name + "'>" + rest + "<collision name='c'><geometry>" + geometry + "</geometry></collision></link>";
}

const std::string kGround =
    "<model name='ground'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 1</normal></plane>"
    "</geometry></collision></link></model>";
const std::string kBall = "<sphere><radius>0.1</radius></sphere>";
const std::string kBrick = "<box><size>0.4 0.4 0.2</size></box>";

std::size_t index_of(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.links.size(); ++i) {
    if (scene.links[i].name == name) return i;
  }
  FAIL("there is no link ", name);
  return 0;
}

dMass mass_of(const World& world, std::size_t link) {
  dMass mass;
  dBodyGetMass(world.body(link), &mass);
  return mass;
}

Eigen::Matrix3d moment_of(const dMass& mass) {
  return Eigen::Map<const Eigen::Matrix<dReal, 3, 4, Eigen::RowMajor>>(mass.I).leftCols<3>();
}

/// The largest difference from `moment`, relative to its largest element.
double error_of(const dMass& mass, const Eigen::Matrix3d& moment) {
  return (moment_of(mass) - moment).cwiseAbs().maxCoeff() / moment.cwiseAbs().maxCoeff();
}

double beta(double x, double y) { return std::tgamma(x) * std::tgamma(y) / std::tgamma(x + y); }

/// The message from reading and building; "" without one.
std::string refusal(const std::string& text, const std::string& name = "file.sdf", double density = 1000) {
  return supernormal::test::refusal<std::exception>([&] { World(scene_of(text, name), density); });
}

void check_refused(const std::string& message, const std::vector<std::string>& says) {
  CAPTURE(message);
  for (const std::string& part : says) {
    CAPTURE(part);
    CHECK(message.find(part) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("robot_model: each shape of shapes.sdf rests on its lowest side") {
  const Scene scene = read_scene(kFolder + "/shapes.sdf");
  CHECK(scene.links.size() == 7);
  CHECK(scene.step == 0.002);
  CHECK(scene.gravity == Eigen::Vector3d(0, 0, -9.81));
  CHECK(scene.not_read.empty());
  World world(scene, 1000);
  world.simulate(10);
  const auto height = [&](const std::string& name) { return world.height(index_of(scene, name + "::link")); };
  CHECK(std::abs(height("ellipsoid") - 0.1) < 1e-3);
  CHECK(std::abs(height("superellipsoid") - 0.1) < 1e-3);
  CHECK(std::abs(height("capsule") - 0.1) < 1e-3);
  CHECK(std::abs(height("cylinder") - 0.1) < 1e-3);
  CHECK(std::abs(height("box") - 0.1) < 1e-3);
  CHECK(std::abs(height("sphere") - 0.15) < 1e-3);
  // The ellipsoid lies flat: its axis z is vertical.
  CHECK(std::abs(world.pose(index_of(scene, "ellipsoid::link")).linear()(2, 2)) > 0.9999);
}

TEST_CASE("robot_model: without <inertial> masses and moments are those of the shapes") {
  const double density = 700;
  const auto check = [=](const std::string& geometry, double expected, const Eigen::Vector3d& moments) {
    CAPTURE(geometry);
    const World world(scene_of(sdf_of(link_of(geometry)), "m.sdf"), density);
    const dMass mass = mass_of(world, 0);
    CHECK(mass.mass == relative(expected).epsilon(1e-12));
    CHECK(error_of(mass, moments.asDiagonal()) < 1e-12);
  };
  double m = density * 4.0 / 3 * kPi * 0.3 * 0.2 * 0.1;
  check("<ellipsoid><radii>0.3 0.2 0.1</radii></ellipsoid>", m, m / 5 * Eigen::Vector3d(0.05, 0.1, 0.13));
  m = density * 4.0 / 3 * kPi * 1e-3;
  check(kBall, m, 0.4 * m * 0.01 * Eigen::Vector3d::Ones());
  m = density * 0.4 * 0.4 * 0.2;
  check(kBrick, m, m / 12 * Eigen::Vector3d(0.2, 0.2, 0.32));
  m = density * kPi * 0.04 * 0.5;
  check("<cylinder><radius>0.2</radius><length>0.5</length></cylinder>", m,
        m * Eigen::Vector3d(0.01 + 0.25 / 12, 0.01 + 0.25 / 12, 0.02));
  {
    const double r = 0.1;
    const double l = 0.4;
    const double middle = density * kPi * r * r * l;
    const double ends = density * 4.0 / 3 * kPi * r * r * r;
    const double across = middle * (r * r / 4 + l * l / 12) + ends * (0.4 * r * r + l * l / 4 + 3 * l * r / 8);
    check("<capsule><radius>0.1</radius><length>0.4</length></capsule>", middle + ends,
          {across, across, middle * r * r / 2 + ends * 0.4 * r * r});
  }
  {
    const double a = 0.3;
    const double b = 0.2;
    const double c = 0.1;
    const double delta = 4;
    const double epsilon = 3;
    const double area = 4 / (delta * delta) * beta(1 / delta, 1 / delta) * delta / 2;  // of |x|^delta + |y|^delta <= 1
    const double second = 4 / (delta * delta) * std::tgamma(3 / delta) * std::tgamma(1 / delta) / std::tgamma(1 + 4 / delta);
    const double volume = area * 2 / epsilon * beta(1 / epsilon, 1 + 2 / epsilon);
    const double square = second * 2 / epsilon * beta(1 / epsilon, 1 + 4 / epsilon);
    const double along = area * 2 / epsilon * beta(3 / epsilon, 1 + 2 / epsilon);
    const double scale = density * a * b * c;
    check("<supernormal:superellipsoid><radii>0.3 0.2 0.1</radii><exponents>4 3</exponents></supernormal:superellipsoid>",
          scale * volume,
          scale * Eigen::Vector3d(b * b * square + c * c * along, a * a * square + c * c * along, (a * a + b * b) * square));
  }
}

TEST_CASE("robot_model: a link of two shapes has the sum of their masses about the common centre") {
  const std::string two =
      "<pose>1 2 3 0 0 0</pose><link name='l'><collision name='a'><pose>0.5 0 0 0 0 0</pose><geometry>" + kBall +
      "</geometry></collision><collision name='b'><pose>-0.25 0 0 0 0 0</pose><geometry><sphere><radius>0.2</radius></sphere>"
      "</geometry></collision></link>";
  const Scene scene = scene_of(sdf_of(two), "m.sdf");
  const World world(scene, 1000);
  const double small = 1000 * 4.0 / 3 * kPi * 1e-3;
  const double large = 8 * small;
  const double along = 0.4 * (small * 0.01 + large * 0.04);
  const double across = along + small * large / (small + large) * 0.75 * 0.75;
  const dMass mass = mass_of(world, 0);
  CHECK(mass.mass == relative(small + large).epsilon(1e-12));
  CHECK(error_of(mass, Eigen::Vector3d(along, across, across).asDiagonal()) < 1e-12);
  const dReal* centre = dBodyGetPosition(world.body(0));
  CHECK(centre[0] == relative(1 + (0.5 - 8 * 0.25) / 9).epsilon(1e-12));
  CHECK((world.pose(0).translation() - Eigen::Vector3d(1, 2, 3)).norm() < 1e-12);
  std::vector<double> at;
  for (dGeomID geom = dBodyGetFirstGeom(world.body(0)); geom != nullptr; geom = dBodyGetNextGeom(geom))
    at.push_back(dGeomGetPosition(geom)[0]);
  std::sort(at.begin(), at.end());
  REQUIRE(at.size() == 2);
  CHECK(at[0] == relative(0.75).epsilon(1e-12));
  CHECK(at[1] == relative(1.5).epsilon(1e-12));
}

TEST_CASE("robot_model: <inertial> is about its own centre and in its own axes") {
  const std::string inertial =
      "<inertial><pose>0.1 0 0 0 0 "
      "0.5</pose><mass>3</mass><inertia><ixx>0.2</ixx><iyy>0.3</iyy><izz>0.4</izz><ixy>0</ixy><ixz>0</ixz>"
      "<iyz>0</iyz></inertia></inertial>";
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.5 + 0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d moment = R * Eigen::Vector3d(0.2, 0.3, 0.4).asDiagonal() * R.transpose();
  const Eigen::Vector3d centre(0.1 * std::cos(0.7), 0.1 * std::sin(0.7), 1);
  const std::string urdf =
      "<robot name='r'><link name='world'/><link name='l'><inertial><origin xyz='0.1 0 0' rpy='0 0 0.5'/><mass value='3'/><inertia "
      "ixx='0.2' "
      "iyy='0.3' izz='0.4' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j' type='continuous'><origin xyz='0 0 1' rpy='0 "
      "0 0.7'/>"
      "<parent link='world'/><child link='l'/></joint></robot>";
  const Scene scenes[] = {scene_of(sdf_of("<pose>0 0 1 0 0 0.7</pose>" + link_of(kBall, inertial)), "m.sdf"),
                          scene_of(urdf, "r.urdf")};
  for (const Scene& scene : scenes) {
    CAPTURE(scene.file);
    const World world(scene, 1000);
    const std::size_t last = scene.links.size() - 1;
    CHECK(mass_of(world, last).mass == 3);
    CHECK(error_of(mass_of(world, last), moment) < 1e-12);
    CHECK((Eigen::Map<const Eigen::Vector3d>(dBodyGetPosition(world.body(last))) - centre).norm() < 1e-12);
    CHECK((world.pose(last).translation() - Eigen::Vector3d(0, 0, 1)).norm() < 1e-12);
  }
}

TEST_CASE("robot_model: links that fixed joints connect are one body") {
  const std::string pair = link_of(kBall, "", "a") + link_of(kBall, "<pose>0 0 0.5 0 0 0</pose>", "b") +
                           "<joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>";
  const Scene scene = scene_of(sdf_of(pair), "m.sdf");
  World world(scene, 1000);
  CHECK(world.body(0) == world.body(1));
  CHECK(world.joints().empty());
  CHECK(mass_of(world, 0).mass == relative(2000 * 4.0 / 3 * kPi * 1e-3).epsilon(1e-12));
  world.simulate(0.3);
  CHECK((world.pose(1).translation() - world.pose(0).translation()).norm() == relative(0.5).epsilon(1e-12));

  const World fixed(
      scene_of(sdf_of(link_of(kBall) + "<joint name='j' type='fixed'><parent>world</parent><child>l</child></joint>"), "m.sdf"),
      1000);
  CHECK(fixed.body(0) == nullptr);
}

TEST_CASE("robot_model: poses refer to the frames of the file") {
  const std::string frames = "<pose>1 0 0 0 0 0</pose><frame name='f'><pose>0 2 0 0 0 1</pose></frame>" +
                             link_of(kBall, "<pose relative_to='f'>0 0 3 0 0 0</pose>");
  const Scene scene = scene_of(sdf_of(frames), "m.sdf");
  CHECK((scene.links[0].pose.translation() - Eigen::Vector3d(1, 2, 3)).norm() < 1e-12);
  CHECK(scene.links[0].pose.linear().isApprox(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST_CASE("robot_model: the joints of arm.urdf come to rest at their stops") {
  const Scene scene = read_scene(kFolder + "/arm.urdf");
  World world(scene, 1000);
  REQUIRE(world.joints().size() == 2);
  // The superellipsoid replaces the box, 12 kg.
  const std::size_t forearm = index_of(scene, "forearm");
  CHECK(std::string(name_of(scene.links[forearm].collisions[0].shape)) == "superellipsoid");
  CHECK(mass_of(world, forearm).mass < 11);
  world.simulate(5);
  CHECK(std::abs(world.pose(index_of(scene, "carriage")).translation().z() - 1) < 1e-3);
  const Eigen::Vector3d tool = world.pose(index_of(scene, "tool")).translation();
  CHECK(std::abs(tool.z() - (1 - 0.6 * std::sin(0.6))) < 1e-3);
  CHECK(std::abs(tool.x() - (0.1 + 0.6 * std::cos(0.6))) < 1e-3);
}

TEST_CASE("robot_model: the joints of SDF move along their axes, in their frames") {
  // Gravity accelerates the slider along its inclined axis.
  const std::string slider =
      link_of(kBall) +
      "<joint name='j' type='prismatic'><pose>0 0 0 0 0.5 0</pose><parent>world</parent><child>l</child><axis><xyz>1 0 0</xyz>"
      "<limit><lower>-9</lower><upper>9</upper></limit></axis></joint>";
  World world(scene_of(sdf_of(slider), "m.sdf"), 1000);
  world.simulate(0.5);
  const double path = 9.8 * std::sin(0.5) * 0.125;
  CHECK((world.pose(0).translation() - path * Eigen::Vector3d(std::cos(0.5), 0, -std::sin(0.5))).norm() < 5e-3 * path);
  CHECK(dJointGetSliderPosition(world.joints().at(0)) == relative(path).epsilon(5e-3));

  // A pendulum of a point-like mass 1 m from its hinge swings with the period 2 pi sqrt(1 / 9.8).
  const std::string pendulum =
      link_of("<sphere><radius>0.01</radius></sphere>", "<pose>0.05 0 -1 0 0 0</pose>") +
      "<joint name='j' type='revolute'><pose relative_to='__model__'>0 0 0 0 0 0</pose><parent>world</parent><child>l</child><axis>"
      "<xyz>0 1 0</xyz></axis></joint>";
  World swing(scene_of(sdf_of(pendulum), "m.sdf"), 1000);
  swing.simulate(kPi / std::sqrt(9.8));
  CHECK(std::abs(swing.pose(0).translation().x() + 0.05) < 1e-3);
}

TEST_CASE("robot_model: a model without a world lies on the plane z = 0") {
  const std::string egg =
      "<robot name='r'><link name='l'><collision><origin xyz='0 0 -5'/><geometry><sphere radius='0.3'/><supernormal:ellipsoid "
      "radii='0.3 0.2 0.1'/>"
      "</geometry></collision></link></robot>";
  World world(scene_of(egg, "egg.urdf"), 1000);
  CHECK(std::abs(world.pose(0).translation().z() - 5.1) < 1e-6);
  world.simulate(1);
  CHECK(std::abs(world.pose(0).translation().z() - 5.1) < 1e-3);
}

TEST_CASE("robot_model: a URDF capsule stands beside a shape that urdfdom reads") {
  const std::string capsule =
      "<robot name='r'><link name='l'><collision><origin rpy='1.5707963267948966 0 0'/><geometry><cylinder radius='0.1' "
      "length='0.6'/>"
      "<supernormal:capsule radius='0.1' length='0.4'/></geometry></collision><collision><origin xyz='0 0 0'/><geometry>"
      "<sphere radius='0.05'/></geometry></collision></link></robot>";
  const Scene scene = scene_of(capsule, "capsule.urdf");
  REQUIRE(scene.links[0].collisions.size() == 2);
  World world(scene, 1000);
  CHECK(mass_of(world, 0).mass == relative(1000 * kPi * (0.01 * 0.4 + 4.0 / 3 * (1e-3 + 0.125e-3))).epsilon(1e-12));
  world.simulate(2);
  CHECK(std::abs(world.height(0) - 0.1) < 1e-3);
}

TEST_CASE("robot_model: links of one model collide if the file says so") {
  for (const bool collides : {false, true}) {
    CAPTURE(collides);
    const std::string stack = std::string("<self_collide>") + (collides ? "true" : "false") + "</self_collide>" +
                              link_of(kBrick, "<pose>0 0 0.1 0 0 0</pose>", "a") +
                              link_of(kBrick, "<pose>0 0 0.35 0 0 0</pose>", "b");
    World world(scene_of(sdf(kGround + model_of("m", stack)), "m.sdf"), 1000);
    world.simulate(2);
    CHECK(std::abs(world.height(1) - 0.1) < 1e-3);
    CHECK(std::abs(world.height(2) - (collides ? 0.3 : 0.1)) < 1e-3);
  }
}

TEST_CASE("robot_model: the smaller coefficient of friction of two bodies acts") {
  const std::string surface = "<collision name='c'><geometry>" + kBrick +
                              "</geometry><surface><friction><ode><mu>0.1</mu></ode></friction></surface></collision>";
  World world(scene_of(sdf("<gravity>2 0 -10</gravity>" + kGround +
                           model_of("m", "<pose>0 0 0.1 0 0 0</pose><link name='l'>" + surface + "</link>") +
                           model_of("n", "<pose>0 5 0.1 0 0 0</pose>" + link_of(kBrick))),
                       "m.sdf"),
              1000);
  world.simulate(1);
  CHECK(dBodyGetLinearVel(world.body(1))[0] == relative(2 - 0.1 * 10).epsilon(0.02));
  CHECK(std::abs(dBodyGetLinearVel(world.body(2))[0]) < 1e-3);
}

TEST_CASE("robot_model: elements that would act on the motion are listed if they are not read") {
  const Scene scene =
      scene_of(sdf_of(link_of(kBall, "<sensor name='s' type='imu'/><visual name='v'><geometry>" + kBall + "</geometry></visual>") +
                      link_of(kBall, "<pose>9 0 0 0 0 0</pose>", "b") +
                      "<joint name='j' type='revolute'><parent>l</parent><child>b</child><axis><xyz>0 0 1</xyz>"
                      "<dynamics><damping>1</damping></dynamics><limit><lower>-4</lower><upper>1</upper></limit></axis></joint>"),
               "m.sdf");
  CHECK(scene.not_read == std::vector<std::string>{"sensor", "dynamics", "limits of j beyond pi"});
  CHECK(scene.joints[0].lower == -std::numeric_limits<double>::infinity());
  CHECK(scene.joints[0].upper == 1);
  const Scene robot = scene_of("<robot name='r'><link name='l'/><transmission name='t'/></robot>", "r.urdf");
  CHECK(robot.not_read == std::vector<std::string>{"transmission"});
}

TEST_CASE("robot_model: a collision with a mesh is left out and told, unless the reader is strict") {
  const Scene scene =
      scene_of(sdf_of("<link name='l'><collision name='c'><geometry><mesh><uri>x.stl</uri></mesh></geometry></collision>"
                      "<collision name='d'><geometry>" +
                      kBall + "</geometry></collision></link>"),
               "m.sdf", false);
  REQUIRE(scene.left_out.size() == 1);
  CHECK(scene.left_out[0].ends_with("m.sdf: link m::l, collision c: <mesh>"));
  REQUIRE(scene.links[0].collisions.size() == 1);
  CHECK(scene.links[0].collisions[0].name == "d");
  const std::string geometry =
      "<collision><geometry><mesh filename='x.stl'/></geometry></collision><collision><geometry><sphere "
      "radius='1'/></geometry></collision>";
  const Scene robot = scene_of("<robot name='r'><link name='l'>" + geometry + "</link></robot>", "r.urdf", false);
  REQUIRE(robot.left_out.size() == 1);
  CHECK(robot.left_out[0].ends_with("r.urdf: link l, collision 1: <mesh>"));
  CHECK(robot.links[0].collisions.size() == 1);
  CHECK_THROWS(scene_of("<robot name='r'><link name='l'>" + geometry + "</link></robot>", "r.urdf"));
}

TEST_CASE("robot_model: every number for no stop is none") {
  for (const char* const number : {"inf", "1e16", "1.79769e+308"}) {
    CAPTURE(number);
    const Scene scene = scene_of(sdf_of(link_of(kBall) + link_of(kBall, "<pose>9 0 0 0 0 0</pose>", "b") +
                                        "<joint name='j' type='prismatic'><parent>l</parent><child>b</child><axis><xyz>0 0 1</xyz>"
                                        "<limit><lower>-" +
                                        std::string(number) + "</lower><upper>" + number + "</upper></limit></axis></joint>"),
                                 "m.sdf");
    CHECK(scene.joints[0].lower == -std::numeric_limits<double>::infinity());
    CHECK(scene.joints[0].upper == std::numeric_limits<double>::infinity());
    CHECK(scene.not_read.empty());
  }
}

TEST_CASE("robot_model: a link without gravity does not fall, and links of one body agree on it") {
  for (const auto& [value, falls] : {std::pair{"1", true}, {"false", false}, {"0", false}, {"true", true}}) {
    const Scene scene =
        scene_of(sdf_of(link_of(kBall, "<pose>0 0 5 0 0 0</pose><gravity>" + std::string(value) + "</gravity>")), "m.sdf");
    World world(scene, 1000);
    world.simulate(0.1);
    CHECK((world.pose(0).translation().z() < 4.99) == falls);
  }
  check_refused(refusal(sdf_of(link_of(kBall, "<gravity>0</gravity>", "a") + link_of(kBall, "<pose>1 0 0 0 0 0</pose>", "b") +
                               "<joint name='j' type='fixed'><parent>a</parent><child>b</child></joint>")),
                {"link m::b", "<gravity>", "must be the same"});
}

TEST_CASE("robot_model: a message names the file, the element, the value and the valid range") {
  const auto of_shape = [](const std::string& geometry) { return refusal(sdf_of(link_of(geometry))); };
  check_refused(of_shape("<sphere><radius>-1</radius></sphere>"),
                {"file.sdf", "link m::l", "collision c", "<sphere>", "-1", "[1e-06, 1e+06] m"});
  check_refused(of_shape("<sphere><radius>1 7</radius></sphere>"), {"<sphere>", "radius", "\"1 7\"", "1 number"});
  check_refused(of_shape("<sphere><radius>nan</radius></sphere>"), {"<sphere>", "radius", "\"nan\""});
  check_refused(of_shape("<box><size>1 2 3 4</size></box>"), {"<box>", "size", "\"1 2 3 4\"", "3 numbers"});
  check_refused(of_shape("<capsule><radius>1</radius></capsule>"), {"<capsule>", "length"});
  check_refused(of_shape("<ellipsoid><radii>1 0 1</radii></ellipsoid>"), {"<ellipsoid>", "radii", "\"1 0 1\"", "[1e-06, 1e+06] m"});
  check_refused(of_shape("<ellipsoid><radii>1 x 1</radii></ellipsoid>"), {"file.sdf", "ellipsoid/radii", "line 1"});
  check_refused(of_shape("<supernormal:superellipsoid><radii>1 1 1</radii><exponents>1 3</exponents></supernormal:superellipsoid>"),
                {"link m::l", "<supernormal:superellipsoid>", "exponents", "\"1 3\"", "2 numbers in [1.01, 1000]"});
  check_refused(of_shape("<supernormal:superellipsoid><radii>1 1 1</radii></supernormal:superellipsoid>"),
                {"supernormal:superellipsoid", "exponents"});
  check_refused(of_shape("<supernormal:egg/>"), {"supernormal:egg", "superellipsoid"});
  check_refused(of_shape("<mesh><uri>x.stl</uri></mesh>"), {"<mesh>", "sphere, box"});
  check_refused(of_shape("<plane><normal>0 0 1</normal></plane>"), {"<plane>", "static"});
  check_refused(refusal(sdf_of("<static>true</static>" + link_of("<plane><normal>0 0 0</normal></plane>"))), {"plane"});
  check_refused(refusal(sdf_of("<link name='l'/>")), {"link m::l", "no mass"});
  check_refused(refusal(sdf_of(link_of(kBall, "<inertial><mass>1</mass></inertial>"))), {"link m::l", "<inertia>"});
  check_refused(refusal(sdf_of(link_of(kBall, "<velocity_decay><linear>2</linear></velocity_decay>"))),
                {"velocity_decay", "2", "[0, 1]"});
  check_refused(refusal(sdf_of(link_of(kBall, "<pose>0 0 nan 0 0 0</pose>"))), {"file.sdf", "pose"});
  check_refused(refusal(sdf_of(link_of(kBall, "", "a") + link_of(kBall, "", "b") +
                               "<joint name='j' type='ball'><parent>a</parent><child>b</child></joint>")),
                {"file.sdf", "joint j", "ball", "revolute"});
  check_refused(refusal(sdf_of(link_of(kBall, "<pose rotation_format='quat_xyzw'>0 0 0 0 0 0 0</pose>"))),
                {"file.sdf", "link l", "quaternion", "0 0 0 0"});
  check_refused(refusal(sdf_of(link_of(kBall) + model_of("n", link_of(kBall)))), {"file.sdf", "model m", "other models"});
  check_refused(refusal(sdf("<physics name='p' type='ode'><max_step_size>0</max_step_size></physics>")),
                {"max_step_size", "0", "[1e-06, 1] s"});
  check_refused(refusal(sdf(""), "file.sdf", -3), {"density", "-3", "[1e-06, 1e+12] kg/m^3"});
  check_refused(refusal("<sdf version='1.9'/>"), {"file.sdf"});
  check_refused(refusal("<mujoco/>"), {"file.sdf", "<mujoco>", "<sdf> or <robot>"});
  check_refused(refusal("<robot"), {"file.sdf", "line 1"});
}

TEST_CASE("robot_model: a message about URDF names the file, the element, the value and the valid range") {
  const auto of_robot = [](const std::string& content) { return refusal("<robot name='r'>" + content + "</robot>", "r.urdf"); };
  const auto of_shape = [&](const std::string& geometry) {
    return of_robot("<link name='l'><collision><geometry>" + geometry + "</geometry></collision></link>");
  };
  const auto of_joint = [&](const std::string& joint) {
    const std::string body =
        "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>";
    return of_robot("<link name='a'>" + body + "<link name='b'>" + body + "<joint name='j' " + joint + "</joint>");
  };
  const std::string ends = "<parent link='a'/><child link='b'/>";
  check_refused(of_shape("<sphere radius='-1'/>"), {"r.urdf", "link l", "collision", "sphere", "radius", "-1", "[1e-06, 1e+06] m"});
  check_refused(of_shape("<sphere radius='1'/><supernormal:ellipsoid radii='1 1'/>"),
                {"link l", "supernormal:ellipsoid", "radii", "\"1 1\"", "3 numbers"});
  check_refused(of_shape("<supernormal:ellipsoid radii='1 1 1'/>"),
                {"r.urdf", "Link [l]", "Unknown geometry type 'supernormal:ellipsoid'"});
  check_refused(of_robot("<link/>"), {"r.urdf", "No name given for the link"});
  check_refused(of_robot("<link name='l'><inertial><mass value='x'/></inertial></link>"),
                {"r.urdf", "link l", "mass/value is \"x\"", "1 number in [1e-18, 1e+18] kg"});
  check_refused(
      of_robot(
          "<link name='a'/><link name='b'/><link name='c'/><joint name='j' type='fixed'><parent link='b'/><child link='c'/></joint>"
          "<joint name='k' type='fixed'><parent link='c'/><child link='b'/></joint>"),
      {"r.urdf", "joints form a loop"});
  check_refused(of_robot("<link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>"
                         "<joint name='k' type='fixed'><parent link='a'/><child link='b'/></joint>"),
                {"r.urdf", "child of several joints"});
  check_refused(of_shape("<mesh filename='x.stl'/>"), {"r.urdf", "<mesh>"});
  check_refused(of_joint("type='floating'>" + ends), {"r.urdf", "joint j", "floating", "revolute"});
  check_refused(of_joint("type='continuous'>" + ends + "<mimic joint='k'/>"), {"r.urdf", "joint j", "mimic"});
  check_refused(of_joint("type='prismatic'>" + ends + "<limit lower='1' upper='-1' effort='1' velocity='1'/>"),
                {"joint j", "1", "-1"});
  check_refused(
      of_robot(
          "<link name='l'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='3' ixy='0' ixz='0' iyz='0'/></inertial></link>"),
      {"r.urdf", "link l", "<inertia>", "3"});
  check_refused(of_robot("<link name='l'><inertial><mass value='-1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' "
                         "iyz='0'/></inertial></link>"),
                {"r.urdf", "link l", "mass", "-1", "[1e-18, 1e+18] kg"});
}

namespace {

// Each number that the reader takes, as {name:value}. The name is in the message about it.
const std::string kNumbersOfSdf =
    "<sdf version='1.9' xmlns:supernormal='urn:supernormal'><world name='w'><gravity>{gravity:0 0 -9.8}</gravity>"
    "<physics name='p' type='ode'><max_step_size>{max_step_size:0.001}</max_step_size></physics>"
    "<model name='g'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>{normal:0 0 1}</normal>"
    "</plane></geometry></collision></link></model>"
    "<model name='m'><pose>{pose:0 0 1 0 0 0}</pose><frame name='f'><pose>{pose:0 0 0 0 0 0}</pose></frame><link name='l'>"
    "<pose relative_to='f'>{pose:0 0 0 0 0 0}</pose><velocity_decay><linear>{linear:0}</linear><angular>{angular:0}</angular>"
    "</velocity_decay><inertial><pose>{pose:0 0 0 0 0 0}</pose><mass>{mass:1}</mass><inertia><ixx>{ixx:1}</ixx><iyy>{iyy:1}</iyy>"
    "<izz>{izz:1}</izz><ixy>{ixy:0}</ixy><ixz>{ixz:0}</ixz><iyz>{iyz:0}</iyz></inertia></inertial>"
    "<collision name='c'><pose>{pose:0 0 0 0 0 0}</pose><geometry><sphere><radius>{radius:1}</radius></sphere></geometry>"
    "<surface><friction><ode><mu>{mu:1}</mu></ode></friction></surface></collision></link>"
    "<link name='k'><pose rotation_format='quat_xyzw'>{pose:5 0 0 0 0 0 1}</pose><collision name='c'><geometry><box>"
    "<size>{size:1 1 1}</size></box></geometry></collision></link>"
    "<joint name='j' type='revolute'><pose>{pose:0 0 0 0 0 0}</pose><parent>l</parent><child>k</child><axis><xyz>{xyz:0 0 1}</xyz>"
    "<limit><lower>{lower:-1}</lower><upper>{upper:1}</upper></limit></axis></joint></model>"
    "<model name='n'><pose>9 0 2 0 0 0</pose><link name='l'><collision name='c'><geometry><supernormal:superellipsoid>"
    "<radii>{radii:1 1 1}</radii><exponents>{exponents:3 3}</exponents></supernormal:superellipsoid></geometry></collision></link>"
    "</model><model name='q'><pose>19 0 2 0 0 0</pose><link name='l'><collision name='c'><geometry><capsule>"
    "<radius>{radius:0.5}</radius><length>{length:1}</length></capsule></geometry></collision></link></model></world></sdf>";

const std::string kNumbersOfUrdf =
    "<robot name='r' xmlns:supernormal='urn:supernormal'><link name='l'><inertial><origin xyz='{xyz:0 0 0}'/>"
    "<mass value='{mass:1}'/><inertia ixx='{ixx:1}' iyy='{iyy:1}' izz='{izz:1}' ixy='{ixy:0}' ixz='{ixz:0}' iyz='{iyz:0}'/>"
    "</inertial><collision><origin xyz='{xyz:0 0 0}' rpy='{rpy:0 0 0}'/><geometry><sphere radius='1'/><supernormal:superellipsoid "
    "radii='{radii:1 1 1}' exponents='{exponents:3 3}'/></geometry></collision></link>"
    "<link name='k'><collision><geometry><box size='{size:1 1 1}'/></geometry></collision></link><link "
    "name='n'><collision><geometry>"
    "<cylinder radius='{radius:1}' length='{length:1}'/></geometry></collision></link>"
    "<joint name='j' type='prismatic'><origin xyz='{xyz:0 0 0}' rpy='{rpy:0 0 0}'/><parent link='l'/><child link='k'/>"
    "<axis xyz='{xyz:0 0 1}'/><limit lower='{lower:-1}' upper='{upper:1}' effort='1' velocity='1'/></joint>"
    "<joint name='i' type='fixed'><origin xyz='3 0 0'/><parent link='k'/><child link='n'/></joint></robot>";

struct Variant {
  std::string name, text;
};

/// The file with `value` as the first word of each number in turn, the others as they are. Value "": all as they are.
std::vector<Variant> variants(const std::string& file, const std::string& value) {
  std::vector<Variant> out;
  const auto count = value.empty() ? 1 : std::count(file.begin(), file.end(), '{');
  for (std::ptrdiff_t changed = 0; changed < count; ++changed) {
    Variant variant;
    std::ptrdiff_t number = 0;
    for (std::size_t at = 0; at < file.size(); ++at) {
      if (file[at] != '{') {
        variant.text += file[at];
        continue;
      }
      const std::size_t colon = file.find(':', at);
      const std::size_t end = file.find('}', at);
      std::string words = file.substr(colon + 1, end - colon - 1);
      if (number++ == changed && !value.empty()) {
        variant.name = file.substr(at + 1, colon - at - 1);
        words.replace(0, words.find(' '), value);
      }
      variant.text += words;
      at = end;
    }
    out.push_back(variant);
  }
  return out;
}

}  // namespace

TEST_CASE("robot_model: every number is refused outside its range, with its name, and ODE never ends the program") {
  const std::vector<std::string> never = {"1e31", "0,3", "nan", "1e400"};
  const std::vector<std::string> maybe = {"1e-320", "1e-30", "0", "-1", "1e6", "1e18"};
  for (const auto& [name, file] : {std::pair<std::string, std::string>("m.sdf", kNumbersOfSdf), {"r.urdf", kNumbersOfUrdf}}) {
    CHECK(refusal(variants(file, "").at(0).text, name).empty());
    for (const std::string& value : never) {
      CAPTURE(value);
      for (const Variant& variant : variants(file, value)) {
        const bool is_no_stop = value == "1e31" && (variant.name == "lower" || variant.name == "upper");
        if (!is_no_stop) check_refused(refusal(variant.text, name), {name, variant.name});
      }
    }
    for (const std::string& value : maybe) {
      CAPTURE(value);
      for (const Variant& variant : variants(file, value)) {
        CAPTURE(variant.name);
        std::string message = "accepted";
        try {
          World world(scene_of(variant.text, name), 1000);
          world.simulate(0.005);
        } catch (const std::exception& error) {
          message = error.what();
        }
        if (message != "accepted") check_refused(message, {name});
      }
    }
  }
  for (const double density : {1e-320, 1e-30, 1e13, 1e300, std::nan("")}) {
    check_refused(refusal(sdf_of(link_of(kBall)), "m.sdf", density), {"density", "[1e-06, 1e+12] kg/m^3"});
  }
}

TEST_CASE("robot_model: a small body far away keeps its moments") {
  const std::string inertial =
      "<inertial><mass>1</mass><inertia><ixx>1e-5</ixx><iyy>1e-5</iyy><izz>1e-5</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia>"
      "</inertial>";
  const World world(scene_of(sdf_of("<pose>1e6 -1e6 1e6 0 0 0</pose>" + link_of(kBall, inertial)), "m.sdf"), 1000);
  CHECK(error_of(mass_of(world, 0), 1e-5 * Eigen::Matrix3d::Identity()) < 1e-12);
}

TEST_CASE("robot_model: a body that flies apart is reported") {
  World world(scene_of(sdf("<gravity>0 0 -1e6</gravity><physics name='p' type='ode'><max_step_size>1</max_step_size></physics>" +
                           model_of("m", link_of(kBall))),
                       "m.sdf"),
              1000);
  std::string message;
  try {
    world.simulate(1e4);
  } catch (const std::exception& error) {
    message = error.what();
  }
  check_refused(message, {"m.sdf", "link m::l", "1e+12 m", "max_step_size 1 s"});
}
