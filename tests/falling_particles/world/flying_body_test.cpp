// Tests of free walls, against closed forms and invariants.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "advise/refusals.hpp"
#include "common/input_error.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/driven_body.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;
namespace fx = supernormal::effects;

namespace {

constexpr double kFlightStep = 5e-4;  // s
constexpr double kWeight = 9.81;      // m/s^2

/// A free wall with the inertia of its solid.
Wall free_wall(WallShape shape, double mass, const Vector3& position, const WallVelocity& velocity = {}) {
  Wall wall{"flier", std::move(shape), {position, Eigen::Quaterniond::Identity()}};
  const supernormal::MassProperties solid = solid_of(wall.shape).value();
  wall.flight = Flight{mass, solid.centroid, mass / solid.volume * solid.inertia(), velocity};
  return wall;
}

/// The triangles of a box, its corner with the lowest coordinates in `corner` (m), their fronts outside.
MeshShape mesh_of_box(const Vector3& corner, const Vector3& size) {
  MeshShape mesh;
  for (int i = 0; i < 8; ++i) {
    const Vector3 vertex = corner + Vector3((i & 1) != 0 ? size.x() : 0, (i & 2) != 0 ? size.y() : 0, (i & 4) != 0 ? size.z() : 0);
    mesh.vertices.push_back({static_cast<float>(vertex.x()), static_cast<float>(vertex.y()), static_cast<float>(vertex.z())});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Open space with these walls.
Scene flight_scene(std::vector<Wall> walls, std::vector<fx::Effect> effects) {
  Scene scene = scene_of(Open{{{5, 5, 5}, {0.2, 0.2, 1}}, {{-10, -10, -10}, {30, 30, 30}}}, {{ball(), 1}});
  scene.walls = std::move(walls);
  scene.effects = std::move(effects);
  scene.time = {10, kFlightStep, 0.1};
  return scene;
}

const std::vector<Placement> kFarGrain = {{0, {5, 5, 5}, {1, 0, 0, 0}}};

}  // namespace

TEST_CASE("free walls: a wall falls by the sum of the speeds of its steps, whatever its centre of mass and its spin") {
  constexpr int kSteps = 1000;
  for (Wall wall : {free_wall(BoxShape{{0.2, 0.1, 0.02}}, 0.3, {0, 0, 1}),
                    free_wall(mesh_of_box({0.1, 0, 0}, {0.2, 0.1, 0.02}), 0.3, {0, 0, 1}, {{0.5, 0, 2}, {3, -2, 8}})}) {
    const Scene scene = flight_scene({wall}, {fx::Gravity{{0, 0, -kWeight}}});
    const Vector3 start = wall.start(wall.flight->centre);
    const World falling(scene, kFarGrain);
    Stepper stepper(falling, scene);
    for (int i = 0; i < kSteps; ++i) stepper.step();
    const Vector3 end = falling.walls().state(0).pose(wall.flight->centre);
    const double time = kSteps * kFlightStep;
    const Vector3 expected = start + time * wall.flight->velocity.linear - Vector3(0, 0, kWeight * time * (time + kFlightStep) / 2);
    CHECK((end - expected).norm() < 1e-12);
    CHECK((falling.walls().flying(0)->velocity - wall.flight->velocity.linear + Vector3(0, 0, kWeight * time)).norm() < 1e-12);
  }
}

TEST_CASE("free walls: a plate that tumbles keeps its angular momentum, and its energy in the mean") {
  // 0.05 rad in a step, about no principal axis.
  const Wall plate = free_wall(BoxShape{{0.2, 0.14, 0.02}}, 0.3, {0, 0, 0}, {{0, 0, 0}, {70, 60, 40}});
  const Scene scene = flight_scene({plate}, {});
  const World world(scene, kFarGrain);
  Stepper stepper(world, scene);
  const Vector3 momentum = plate.flight->inertia * plate.flight->velocity.angular;
  const double energy = momentum.dot(plate.flight->velocity.angular) / 2;  // J
  const auto energy_now = [&] {
    const Eigen::Matrix3d turned = world.walls().state(0).pose.rotation.toRotationMatrix();
    return momentum.dot(turned * plate.flight->inertia.inverse() * turned.transpose() * momentum) / 2;
  };
  double largest = 0;
  for (int i = 0; i < 20000; ++i) {
    stepper.step();
    largest = std::max(largest, std::abs(energy_now() / energy - 1));
  }
  CHECK((world.walls().flying(0)->momentum - momentum).norm() < 1e-11 * momentum.norm());
  CHECK(largest < 1e-4);  // it oscillates with the square of the step
  CHECK((world.walls().state(0).pose.position).norm() < 1e-12);
}

TEST_CASE("free walls: grains that hit a plate give it their momentum and angular momentum") {
  const Wall plate = free_wall(BoxShape{{0.1, 0.1, 0.01}}, 0.05, {0, 0, 0}, {{0.1, 0, 0}, {2, 1, 3}});
  Scene scene = flight_scene({plate}, {fx::Friction{0.4, {}}, fx::Restitution{0.6, 0, {}}});
  scene.kinds = {{ball(), 2}};
  const std::vector<Placement> placements = {{0, {0.03, 0.01, 0.05}, {1, 0, 0, 0}, 1, {0, 0.1, -1}, {5, 3, 2}},
                                             {0, {-0.02, 0.03, -0.05}, {1, 0, 0, 0}, 1, {0.2, 0, 1.3}, {0, -40, 2}}};
  const World world(scene, placements);
  Stepper stepper(world, scene);
  const auto momenta = [&] {
    const WallState state = world.walls().state(0);
    const FlightState& flight = *world.walls().flying(0);
    Vector3 linear = 0.05 * flight.velocity;
    Vector3 angular = flight.momentum + state.pose.position.cross(linear);
    for (const Grain& grain : world.present()) {
      const Vector3 momentum = grain.mass.mass * Vector3(grain.velocity().data());
      const dReal* spin = dBodyGetAngularVel(grain.body);
      linear += momentum;
      angular += Vector3(grain.position().data()).cross(momentum) + grain.mass.I[0] * Vector3(spin[0], spin[1], spin[2]);
    }
    return std::pair(linear, angular);
  };
  const auto [linear, angular] = momenta();
  std::size_t contacts = 0;
  for (int i = 0; i < 400; ++i) {
    stepper.step();
    contacts += stepper.contacts();
  }
  CHECK(contacts > 0);
  CHECK(world.grains()[0].velocity()[2] > 0);
  CHECK(world.grains()[1].velocity()[2] < 0);
  const auto [linear_now, angular_now] = momenta();
  CHECK((linear_now - linear).norm() < 1e-9 * linear.norm());
  CHECK((angular_now - angular).norm() < 1e-9 * angular.norm());
}

TEST_CASE("free walls: a lid on grains rests, and they bear its weight") {
  const Wall floor{"floor", PlaneShape{}};
  const Wall lid = free_wall(CylinderShape{0.05, 0.01}, 0.2, {0, 0, 0.0151});
  Scene scene = flight_scene({floor, lid}, {fx::Gravity{{0, 0, -kWeight}}, fx::Friction{0.4, {}}, fx::MaxCorrectingVelocity{0.05},
                                            fx::SurfaceLayer{1e-5}, fx::RollingResistance{1e-4, 1e-4, {}}});
  scene.kinds = {{ball(), 3}};
  scene.solver.iterations = 200;
  std::vector<Placement> placements;
  for (const double angle : {0.3, 2.2, 4.4}) {
    placements.push_back({0, {0.03 * std::cos(angle), 0.03 * std::sin(angle), 0.005}, {1, 0, 0, 0}});
  }
  const World world(scene, placements);
  Stepper stepper(world, scene);
  for (int i = 0; i < 4000; ++i) stepper.step(i == 3999);
  const WallState state = world.walls().state(1);
  CHECK(state.velocity.linear.norm() < 1e-4);
  CHECK(state.velocity.angular.norm() < 1e-3);
  CHECK(std::abs(state.pose.position.z() - 0.015) < 5e-5);
  CHECK((state.pose.rotation * Vector3::UnitZ() - Vector3::UnitZ()).norm() < 1e-3);
  double on_lid = 0, on_floor = 0;  // N
  for (const MeasuredContact& contact : stepper.measured_contacts()) {
    const bool is_first = grain_of(contact.geom.g1) == nullptr;
    const double force = (is_first ? 1 : -1) * contact.force()[2];
    (world.walls().wall_of(is_first ? contact.geom.g1 : contact.geom.g2)->name == "floor" ? on_floor : on_lid) += force;
  }
  CHECK(on_lid == relative(0.2 * kWeight).epsilon(0.01));
  CHECK(on_floor == relative(-kWeight * (0.2 + 3 * world.grains()[0].mass.mass)).epsilon(0.01));
}

TEST_CASE("free walls: they rest and slide on other walls, with the friction of grains on these") {
  const Vector3 size(0.1, 0.08, 0.04);
  const std::vector<fx::Effect> effects = {fx::Gravity{{0, 0, -kWeight}}, fx::Friction{0.5, {}}};
  Wall ground{"ground", BoxShape{{2, 2, 0.1}}, {{0, 0, -0.05}, Eigen::Quaterniond::Identity()}};
  for (const Wall& floor : {Wall{"floor", PlaneShape{}}, ground}) {
    for (const bool is_mesh : {false, true}) {
      CAPTURE(floor.name);
      CAPTURE(is_mesh);
      const WallShape shape = is_mesh ? WallShape(mesh_of_box(-size / 2, size)) : WallShape(BoxShape{size});
      const Scene scene = flight_scene({floor, free_wall(shape, 0.5, {0, 0, 0.02}, {{1, 0, 0}, {}})}, effects);
      const World world(scene, kFarGrain);
      Stepper stepper(world, scene);
      for (int i = 0; i < 2000; ++i) stepper.step();
      const WallState state = world.walls().state(1);
      CHECK(state.pose.position.x() == relative(1 / (2 * 0.5 * kWeight)).epsilon(0.02));
      CHECK(std::abs(state.pose.position.z() - 0.02) < 1e-4);
      CHECK(state.velocity.linear.norm() < 1e-3);
      CHECK(stepper.contacts() == 0);  // of grains
      CHECK(stepper.costs().contacts_of_walls > 2000);
    }
  }
}

TEST_CASE("free walls: a wall is held until its flight starts") {
  Wall wall = free_wall(BoxShape{{0.1, 0.1, 0.1}}, 1, {0, 0, 1}, {{1, 0, 0}, {0, 0, 2}});
  wall.flight->from = 0.1;
  const Scene scene = flight_scene({wall}, {fx::Gravity{{0, 0, -kWeight}}});
  const World world(scene, kFarGrain);
  Stepper stepper(world, scene);
  for (int i = 0; i < 200; ++i) stepper.step();
  CHECK(world.walls().state(0).pose.position == Vector3(0, 0, 1));
  CHECK(world.walls().state(0).velocity.is_zero());
  for (int i = 0; i < 100; ++i) stepper.step();
  CHECK(world.walls().state(0).pose.position.x() == relative(0.05).epsilon(1e-9));
  CHECK(world.walls().state(0).velocity.angular.z() == relative(2).epsilon(1e-9));
}

TEST_CASE("free walls: a run goes on to the bit from what it has saved") {
  const Wall plate = free_wall(mesh_of_box({-0.05, -0.05, 0}, {0.1, 0.12, 0.01}), 0.05, {0, 0, 0.1}, {{0.1, 0, 0}, {20, 10, 3}});
  const Scene scene = flight_scene({{"floor", PlaneShape{}}, plate}, {fx::Gravity{{0, 0, -kWeight}}, fx::Friction{0.4, {}}});
  const World world(scene, kFarGrain);
  Stepper stepper(world, scene);
  for (int i = 0; i < 100; ++i) stepper.step();
  const auto end_of = [&, state = world.save()] {
    const World again(scene, World::GoOn{}, state);
    Stepper next(again, scene);
    for (int i = 0; i < 300; ++i) next.step();
    return again.walls().state(1).pose;
  };
  const WallPose first = end_of(), second = end_of();
  CHECK(first.position == second.position);
  CHECK(first.rotation.coeffs() == second.rotation.coeffs());
  CHECK(first.position.z() < 0.1);
}

TEST_CASE("free walls: the solid of a mesh has the volume, centre and inertia of the box that it is") {
  const Vector3 size(0.2, 0.1, 0.03), corner(0.3, -0.1, 0.05);
  const auto of_mesh = solid_of(mesh_of_box(corner, size)).value();
  const auto of_box = solid_of(BoxShape{size}).value();
  CHECK(of_mesh.volume == relative(of_box.volume).epsilon(1e-6));  // vertices are floats
  CHECK((of_mesh.centroid - corner - size / 2).norm() < 1e-7);
  CHECK((of_mesh.inertia() - of_box.inertia()).norm() < 1e-5 * of_box.inertia().norm());
  CHECK(of_box.inertia()(0, 0) == relative(of_box.volume * (0.1 * 0.1 + 0.03 * 0.03) / 12).epsilon(1e-12));
  MeshShape open = mesh_of_box(corner, size);
  open.triangles.pop_back();
  CHECK(!solid_of(open));
  MeshShape inside_out = mesh_of_box(corner, size);
  for (auto& [a, b, c] : inside_out.triangles) std::swap(b, c);
  CHECK(!solid_of(inside_out));
  CHECK(!solid_of(PlaneShape{}));
}

TEST_CASE("free walls: a start within another wall is refused, and one that touches is not") {
  const auto said = [](double height, double overlap = 0) -> std::string {
    Scene scene =
        flight_scene({{"floor", PlaneShape{}}, free_wall(mesh_of_box({-0.05, -0.05, 0}, {0.1, 0.1, 0.01}), 1, {0, 0, height})}, {});
    scene.called = "scene.toml";
    if (overlap > 0) {
      scene.start.emplace();
      scene.start->overlap = overlap;
      scene.start->grains.push_back({.position = {5, 5, 5}});
    }
    return refusal_by([&] { refuse_bad_start(scene); });
  };
  CHECK(said(0).empty());
  CHECK(said(0.1).empty());
  check_says(said(-0.002), {"scene.toml: part \"flier\", which is free, is 0.002 m deep in part \"floor\" at the start; allowed: a "
                            "start apart from all other walls, or a section [start], whose start.overlap allows more"});
  // Beside a state, a part at rest starts as deep as it lay: up to 0.1 of the smallest half-axis, 5 mm.
  CHECK(said(-3e-7, 0.1).empty());
  CHECK(said(-0.0004999, 0.1).empty());
  check_says(said(-0.0005001, 0.1),
             {"part \"flier\", which is free, is 0.0005 m deep", "allowed: up to 0.0005 m, from start.overlap"});
}

TEST_CASE("free walls: mistakes are refused with their name, value and range") {
  const auto says = [](const std::string& part, const std::vector<const char*>& parts) {
    std::string text = kSceneText;
    text += "[[part]]\nname = \"p\"\nposition = [0, 0, 1]\n";
    text += part;
    check_says(complaint(text), parts);
  };
  const std::string box = "shape = \"box\"\nsize = [0.01, 0.01, 0.001]\n";
  CHECK(complaint(std::string(kSceneText) + "[[part]]\nname = \"p\"\n" + box + "free = { mass = 0.1 }\n").empty());
  says(box + "free = {}\n", {"free.mass is missing", "[1e-12, 1e+06] kg"});
  says(box + "free = { mass = 0 }\n", {"mass is 0; allowed: a number in [1e-12, 1e+06] kg"});
  says(box + "free = { mass = 1, inertia = [1, 1, 3] }\n",
       {"inertia is [1, 1, 3] kg m^2, which no body has; allowed: moments of which none exceeds the sum of the others"});
  says(box + "free = { mass = 1, inertia = [1, 1, 0] }\n", {"inertia", "[1e-18, 1e+12] kg m^2"});
  says(box + "free = { mass = 1, velocity = [0, 0, 2000] }\n", {"velocity", "[-1000, 1000] m/s"});
  says(box + "free = { mass = 1, angular_velocity = [0, 0, 2000] }\n",
       {"angular_velocity is 2e+03 rad/s; allowed: up to 1.26e+03 rad/s, a tenth of a revolution in a step"});
  says(box + "free = { mass = 1, until = 3 }\n", {"until"});
  says(box + "free = { mass = 1 }\nmotion = [{ kind = \"velocity\", velocity = [0, 0, 1] }]\n",
       {"part.free beside part.motion; allowed: one of both"});
  says(box + "free = { mass = 1 }\ndrive = { axis = [0, 0, 1], force = 1, mass = 1 }\n", {"part.free beside part.drive"});
  says("shape = \"plane\"\nfree = { mass = 1 }\n", {"part.free of a plane, which is infinite; allowed: with the other shapes"});
}
