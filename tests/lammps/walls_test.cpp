// Walls: where particles touch them, and the histories of the contacts.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "flat_bodies.hpp"
#include "kernel/walls/mesh_wall.hpp"
#include "kernel/walls/wall.hpp"
#include "kernel/walls/wall_contacts.hpp"
#include "support/relative.hpp"

using namespace granular;
using namespace granular::test;
using supernormal::Pose;
using supernormal::test::relative;

namespace {

std::vector<WallContact> contacts_of(Wall& wall, const ParticleShape& shape, const Pose& pose) {
  std::vector<WallContact> contacts;
  wall.add_contacts(shape, pose, contacts);
  return contacts;
}

Pose at(const Vector3& position, const Eigen::Quaterniond& rotation = Eigen::Quaterniond::Identity()) {
  return {position, rotation.normalized().toRotationMatrix()};
}

/// A square floor of two triangles, z = 0.
std::vector<supernormal::MeshTriangle> square(double half) {
  return {{{Vector3(-half, -half, 0), Vector3(half, -half, 0), Vector3(half, half, 0)}, 0},
          {{Vector3(-half, -half, 0), Vector3(half, half, 0), Vector3(-half, half, 0)}, 1}};
}

const Vector3 kAxes(0.02, 0.012, 0.008);  // m

}  // namespace

TEST_CASE("lammps: a ball in a corner touches three walls, each as a plane") {
  BoxWall box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
  const ParticleShape ball(Vector3::Constant(0.01), 2, 2);
  const auto contacts = contacts_of(box, ball, at({0.0905, -0.091, 0.092}));
  REQUIRE(contacts.size() == 3);
  for (const WallContact& contact : contacts) {
    int axis = 0;
    contact.normal.cwiseAbs().maxCoeff(&axis);
    CHECK(contact.depth == relative(std::abs(Vector3(0.0005, 0.001, 0.002)[axis])).epsilon(1e-10));
    CHECK(contact.point.cwiseAbs()[axis] >= 0.1);
  }
  CHECK(contacts_of(box, ball, at({0, 0.089, 0})).empty());
  CHECK_THROWS_AS(BoxWall({0, 0, 0}, {1, 1, 0}), std::invalid_argument);
}

TEST_CASE("lammps: a ball in a drum overlaps it by the length that sticks out") {
  const ParticleShape ball(Vector3::Constant(0.01), 2, 2);
  const Vector3 axis = Vector3(1, 2, 0.5).normalized(), point(0.3, 0.1, -0.2);
  CylinderWall drum(point, axis, 0.1);
  const Vector3 across = axis.unitOrthogonal();
  for (const double angle : {0.0, 0.1, 1.0, 3.0}) {
    const Vector3 u = Eigen::AngleAxisd(angle, axis) * across;
    const auto contacts = contacts_of(drum, ball, at(point + 0.7 * axis + 0.0905 * u));
    REQUIRE(contacts.size() == 1);
    CHECK(contacts[0].depth == relative(0.0005).epsilon(1e-9));
    CHECK((contacts[0].normal - u).norm() < 1e-9);
    CHECK((contacts[0].point - (point + 0.7 * axis + 0.1005 * u)).norm() < 1e-9);
    // The drum is hollow across its axis, and straight along it.
    const Vector3 along = axis.cross(u);
    CHECK(along.dot(contacts[0].curvature * along) == relative(-10).epsilon(1e-9));
    CHECK((contacts[0].curvature * axis).norm() < 1e-9);
  }
  CHECK(contacts_of(drum, ball, at(point + 0.0899 * across)).empty());
  CHECK_THROWS_AS(CylinderWall(point, Vector3::Zero(), 1), std::invalid_argument);
  CHECK_THROWS_AS(CylinderWall(point, axis, 0), std::invalid_argument);
}

TEST_CASE("lammps: the deepest contact with a drum is the point of the body farthest from its axis") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (const auto& [delta, epsilon] : {std::pair(2.0, 2.0), {1.4, 3.0}, {6.0, 6.0}, {20.0, 1.6}}) {
    const ParticleShape shape(kAxes, delta, epsilon);
    CylinderWall drum(Vector3::Zero(), Vector3::UnitZ(), 0.03);
    int touching = 0;
    for (int i = 0; i < 40; ++i) {
      const Pose pose =
          at({0.02 * unit(random), 0.02 * unit(random), unit(random)}, {unit(random), unit(random), unit(random), unit(random)});
      double farthest = 0;
      for (int k = 0; k < 20000; ++k) {
        const double angle = 2 * std::numbers::pi * k / 20000;
        const Vector3 u(std::cos(angle), std::sin(angle), 0);
        farthest = std::max(farthest, u.dot(pose.position) + shape.body.support(pose.rotation.transpose() * u));
      }
      double deepest = 0;
      for (const WallContact& contact : contacts_of(drum, shape, pose)) {
        deepest = std::max(deepest, contact.depth);
        // The normal is the body's there.
        const Vector3 there = pose.position + pose.rotation * shape.body.point(pose.rotation.transpose() * contact.normal);
        CHECK((there - contact.point).norm() < 1e-9);
      }
      CHECK(std::abs(deepest - std::max(0.0, farthest - 0.03)) < 1e-9);
      touching += deepest > 0 ? 1 : 0;
    }
    CHECK(touching > 5);
    CHECK(touching < 40);
  }
}

TEST_CASE("lammps: a rod across a drum lies on both of its ends") {
  const ParticleShape rod({0.03, 0.004, 0.004}, 2, 2);
  CylinderWall drum(Vector3::Zero(), Vector3::UnitY(), 0.05);
  const auto contacts = contacts_of(drum, rod, at({0, 0, -0.0402}));
  REQUIRE(contacts.size() == 2);
  CHECK(contacts[0].depth == relative(contacts[1].depth).epsilon(1e-9));
  CHECK(contacts[0].normal.x() == relative(-contacts[1].normal.x()).epsilon(1e-9));
}

TEST_CASE("lammps: the energy of a rod in a drum has no jump where one contact becomes two, and the torque is its slope") {
  constexpr int kTurns = 15'000;
  constexpr double kTurn = 0.5 * std::numbers::pi / kTurns;
  Floor drum;
  drum.wall = std::make_shared<CylinderWall>(Vector3::Zero(), Vector3::UnitY(), 0.05);
  const ContactMaterial material = prepared({.stiffness = 1e5});
  for (const double exponent : {2.0, 3.0, 6.0}) {
    Particle rod({0.03, 0.004, 0.004}, 2, exponent);
    for (const double aside : {0.0, 0.0007}) {
      CAPTURE(exponent);
      CAPTURE(aside);
      double miss = 0, least = 1;
      int fewest = 2, most = 0, pulls = 0;
      WallForce last;
      for (int k = 0; k < kTurns; ++k) {
        const double yaw = k * kTurn;
        rod.place({aside, 0, -0.0461}, Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3::UnitZ())));
        const WallForce force = drum.find(rod, material, 0);
        const WallForce of_hertz = drum.find(rod, prepared({.law = NormalLaw::Hertz, .stiffness = 1e8}), 0);
        pulls += of_hertz.force.z() <= 0 || of_hertz.energy <= 0 ? 1 : 0;
        const double work = 0.5 * kTurn * (last.torque + force.torque).z();
        if (k > 0) miss = std::max(miss, std::abs(force.energy - last.energy + work));
        least = std::min(least, force.energy);
        fewest = std::min(fewest, force.contacts);
        most = std::max(most, force.contacts);
        last = force;
      }
      CHECK(most == 2);
      CHECK(pulls == 0);
      if (exponent == 2) CHECK(fewest == 1);
      CHECK(miss < 5e-3 * least);
    }
  }
}

TEST_CASE("lammps: a floor of triangles has the contacts of a plane") {
  MeshWall mesh(square(0.5));
  PlaneWall plane(Vector3::Zero(), Vector3::UnitZ());
  const ParticleShape shape(kAxes, 3, 1.6);
  for (const double height : {0.012, 0.010, 0.006, 0.004}) {
    const Pose pose = at({0.01, 0.02, height}, {1, 0.3, 0.2, 0.5});
    const auto on_mesh = contacts_of(mesh, shape, pose), on_plane = contacts_of(plane, shape, pose);
    REQUIRE(on_mesh.size() == on_plane.size());
    if (on_plane.empty()) continue;
    CHECK(on_mesh[0].depth == relative(on_plane[0].depth).epsilon(1e-12));
    CHECK((on_mesh[0].point - on_plane[0].point).norm() < 1e-12);
    CHECK((on_mesh[0].normal + Vector3::UnitZ()).norm() < 1e-12);
  }
  CHECK_THROWS_AS(MeshWall({}), std::invalid_argument);
}

TEST_CASE("lammps: a belt drags a ball along, and the wall's force and torque are opposite to the particle's") {
  PlaneWall plane(Vector3::Zero(), Vector3::UnitZ());
  Particle ball(Vector3::Constant(0.01), 2, 2);
  const ContactMaterial material = prepared({.stiffness = 1e4, .friction = 0.5});
  Body belt;
  belt.pose = at({0.5, 0.2, 0});
  belt.velocity = {1, 0, 0};
  WallHistory history;
  std::vector<WallContact> scratch;
  ball.place({0, 0, 0.0099}, Eigen::Quaterniond::Identity());
  WallForce found;
  for (int i = 0; i < 100; ++i) found = find_wall_force(plane, belt, *ball.shape, ball.body, material, 1e-5, history, scratch);
  CHECK(found.contacts == 1);
  CHECK(found.force.z() == relative(1e4 * 1e-4).epsilon(1e-9));
  CHECK(found.force.x() == relative(0.5 * found.force.z()).epsilon(1e-9));
  CHECK((found.torque + found.wall_torque + (ball.body.pose.position - belt.pose.position).cross(found.force)).norm() < 1e-15);
  // Off the belt the history is deleted.
  CHECK(history.count == 1);
  ball.place({0, 0, 0.011}, Eigen::Quaterniond::Identity());
  CHECK(find_wall_force(plane, belt, *ball.shape, ball.body, material, 1e-5, history, scratch).contacts == 0);
  CHECK(history.count == 0);
}

TEST_CASE("lammps: in a corner each wall has its own springs, in any order of the contacts") {
  BoxWall box({-0.1, -0.1, 0}, {0.1, 0.1, 0.2});
  Particle ball(Vector3::Constant(0.01), 2, 2);
  ball.set_velocity({0, 0.1, 0}, Vector3::Zero());
  const ContactMaterial material = prepared({.stiffness = 1e4, .friction = 0.5});
  Body walls;
  walls.pose = at({0, 0, 0});
  WallHistory history;
  std::vector<WallContact> scratch;
  // First only on the floor, then also against the wall x = -0.1, which the box lists before the floor.
  ball.place({0, 0, 0.0099}, Eigen::Quaterniond::Identity());
  for (int i = 0; i < 10; ++i) find_wall_force(box, walls, *ball.shape, ball.body, material, 1e-5, history, scratch);
  const Vector3 spring = history.contacts[0].sliding;
  CHECK(spring.norm() == relative(1e-5).epsilon(1e-6));
  ball.place({-0.0901, 0, 0.0099}, Eigen::Quaterniond::Identity());
  find_wall_force(box, walls, *ball.shape, ball.body, material, 1e-5, history, scratch);
  REQUIRE(history.count == 2);
  for (int k = 0; k < 2; ++k) {
    const ContactHistory& one = history.contacts.at(static_cast<std::size_t>(k));
    CHECK(one.sliding.norm() == relative(one.normal.z() < -0.5 ? 1.1e-5 : 1e-6).epsilon(1e-6));
  }
}

namespace {

/// A brick, a can or a pillow on one of its faces or sides, tilted by up to `tilt` (rad).
Particle flat_body(int kind, double tilt, Random& random) {
  Particle body{kBrick, kind == 1 ? random(1.5, 3.5) : random(6, 30), kind == 2 ? random(1.5, 3.5) : random(6, 30)};
  const Eigen::Quaterniond rolled(Eigen::AngleAxisd(random(-3, 3), Vector3::Unit(kind == 1 ? 2 : 1)));
  const Eigen::Quaterniond up = kind == 0   ? face_up(static_cast<int>(random(0, 2.999)))
                                : kind == 1 ? Eigen::Quaterniond(kLies * rolled)
                                            : rolled;
  body.place(Vector3::Zero(), tilted(random(0, tilt), random) * up);
  return body;
}

/// A plane of which there are two triangles that bear faces and sides.
class PartOfPlane final : public Wall {
 public:
  void add_contacts(const ParticleShape& shape, const Pose& pose, std::vector<WallContact>& contacts) override {
    plane_.add_contacts(shape, pose, contacts);
    for (WallContact& contact : contacts) {
      contact.ground->frame.setIdentity();
      contact.ground->origin.setZero();
      contact.ground->is_surface = true;
      contact.ground->patches = patches_;
    }
  }

 private:
  static constexpr double kHalf = 0.05;
  PlaneWall plane_{Vector3::Zero(), Vector3::UnitZ()};
  std::array<Vector2, 3> below_{Vector2(-kHalf, -kHalf), Vector2(kHalf, -kHalf), Vector2(kHalf, kHalf)};
  std::array<Vector2, 3> above_{Vector2(-kHalf, -kHalf), Vector2(kHalf, kHalf), Vector2(-kHalf, kHalf)};
  std::array<Patch, 2> patches_{below_, above_};
};

}  // namespace

TEST_CASE("lammps: a floor of triangles bears faces and sides as a plane does, also over a seam") {
  Random random{std::mt19937(14)};
  const ContactMaterial material = prepared({.stiffness = 1e5});
  Floor mesh, plane;
  mesh.wall = std::make_shared<MeshWall>(square(0.5));
  int in_contact = 0;
  for (int i = 0; i < 150; ++i) {
    Particle body = flat_body(i % 3, 0.1, random);
    const Vector3 aside = 0.01 * random.vector(1);
    const auto place = [&](double height) { body.place({aside.x(), aside.y(), height}, body.attitude); };
    const double height = touching_height(0.05, 1e-5, place, [&] { return plane.find(body, material, 0).contacts > 0; });
    // From just above the floor, where only faces touch, into it.
    for (const double depth : {-1e-5, -2e-6, 0.0, 1e-6, 1e-5, 1e-4}) {
      place(height - depth);
      const WallForce on_mesh = mesh.find(body, material, 0), on_plane = plane.find(body, material, 0);
      CHECK(on_mesh.contacts == on_plane.contacts);
      CHECK((on_mesh.force - on_plane.force).norm() < 1e-9);
      CHECK((on_mesh.torque - on_plane.torque).norm() < 1e-11);
      in_contact += on_plane.contacts;
    }
  }
  CHECK(in_contact > 500);
}

namespace {

/// A square of 0.1 m around `middle`, in cells of a size (m), with coordinates in single precision.
std::vector<supernormal::MeshTriangle> rounded_slope(const Eigen::Quaterniond& slope, const Vector3& middle, double cell) {
  const int count = static_cast<int>(std::lround(0.1 / cell));
  const auto corner = [&](int i, int j) -> Vector3 {
    return (middle + slope * Vector3(i * cell - 0.05, j * cell - 0.05, 0)).cast<float>().cast<double>();
  };
  std::vector<supernormal::MeshTriangle> triangles;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      const int index = static_cast<int>(triangles.size());
      triangles.push_back({{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)}, index});
      triangles.push_back({{corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)}, index + 1});
    }
  }
  return triangles;
}

}  // namespace

TEST_CASE("lammps: a slope of triangles in single precision is one plane") {
  Random random{std::mt19937(17)};
  const ContactMaterial material = prepared({.stiffness = 1e5});
  const Eigen::Quaterniond slope(Eigen::AngleAxisd(0.4, Vector3(0.3, 1, 0).normalized()));
  const double depth = 1e-4;
  for (const double away : {0.0, 1.0}) {
    const Vector3 middle = away * Vector3(1, 0.7, 0.4), up = slope * Vector3::UnitZ();
    Floor mesh, plane;
    plane.wall = std::make_shared<PlaneWall>(middle, up);
    for (const double cell : {2e-3, 5e-3, 2e-2}) {
      mesh.wall = std::make_shared<MeshWall>(rounded_slope(slope, middle, cell));
      for (int i = 0; i < 30; ++i) {
        Particle body = flat_body(i % 3, i % 2 == 0 ? 0 : 0.1, random);
        const Eigen::Quaterniond attitude = slope * body.attitude;
        const auto place = [&](double height) { body.place(middle + height * up, attitude); };
        place(touching_height(0.05, 1e-5, place, [&] { return plane.find(body, material, 0).contacts > 0; }) - depth);
        const WallForce on_mesh = mesh.find(body, material, 0), on_plane = plane.find(body, material, 0);
        CAPTURE(away);
        CAPTURE(cell);
        CAPTURE(i);
        CHECK(on_mesh.contacts == on_plane.contacts);
        // Triangles of 2 mm at 1 m are off by up to 1e-4 rad.
        CHECK((on_mesh.force - on_plane.force).norm() < 0.03 * on_plane.force.norm());
      }
    }
  }
}

TEST_CASE("lammps: at the border of a surface, forces of faces and sides are the derivatives of the energy") {
  Random random{std::mt19937(15)};
  Floor floor;
  floor.wall = std::make_shared<PartOfPlane>();
  for (int i = 0; i < 200; ++i) {
    Particle body = flat_body(i % 3, 0.1, random);
    const double angle = random(0, 2 * std::numbers::pi);
    check_slopes(body, body.attitude, sticky(i), floor, {0.042 * std::cos(angle), 0.042 * std::sin(angle), 0});
  }
}

TEST_CASE("lammps: a brick slides over the border of a table without a jump") {
  Floor table;
  table.wall = std::make_shared<MeshWall>(square(0.05));
  const ContactMaterial material = prepared({.stiffness = 1e5});
  Particle brick(kBrick, 20, 20);
  double last = 1;
  for (int k = 0; k < 4000; ++k) {
    brick.place({1e-5 * k, 0.003, kBrick.z() - 1e-5}, Eigen::Quaterniond::Identity());
    const double force = table.find(brick, material, 0).force.z();
    CHECK(std::abs(force - last) < 0.02);
    last = force;
  }
}

TEST_CASE("lammps: forces of a can in a pipe are the derivatives of the energy") {
  Random random{std::mt19937(16)};
  Floor pipe;
  pipe.wall = std::make_shared<CylinderWall>(Vector3(0, 0, 0.04), Vector3::UnitX(), 0.04);
  for (int i = 0; i < 100; ++i) {
    Particle can{{0.01, 0.012, 0.02}, random(1.5, 3), random(8, 30)};
    const Eigen::Quaterniond rolled(Eigen::AngleAxisd(random(-3, 3), Vector3::UnitZ()));
    const Eigen::Quaterniond askew(Eigen::AngleAxisd(random(-0.1, 0.1), random.vector(1).normalized()));
    check_slopes(can, askew * kLies * rolled, sticky(i), pipe, {0, random(-0.01, 0.01), -0.01});
  }
}

TEST_CASE(
    "lammps: a level can in a pipe has the stiffness of one contact, and askew it goes over to both of its ends without a jump") {
  Floor pipe;
  pipe.wall = std::make_shared<CylinderWall>(Vector3(0, 0, 0.011), Vector3::UnitX(), 0.011);
  const ContactMaterial material = prepared({.stiffness = 1e5});
  Particle can({0.01, 0.01, 0.03}, 2, 20);
  can.place({0, 0, 0.01 - 1e-5}, kLies);
  const WallForce level = pipe.find(can, material, 0);
  CHECK(level.contacts == 1);
  CHECK(level.force.z() == relative(1).epsilon(1e-9));
  CHECK(level.torque.norm() < 1e-12);
  double last = 1;
  for (int k = 0; 1e-6 * k < can.shape->sides.at(0).tilt; ++k) {
    can.place({0, 0, 0.01 - 1e-5}, Eigen::Quaterniond(Eigen::AngleAxisd(1e-6 * k, Vector3::UnitZ())) * kLies);
    const WallForce askew = pipe.find(can, material, 0);
    CHECK(std::abs(askew.force.z() - last) < 5e-3);
    last = askew.force.z();
  }
  CHECK(pipe.find(can, material, 0).contacts == 2);
}
