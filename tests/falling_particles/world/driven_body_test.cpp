// Tests of walls that a torque, a power or a servo drives, against closed forms.
#include "world/driven_body.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "common/drive.hpp"
#include "model/wall.hpp"
#include "scenes.hpp"
#include "support/relative.hpp"
#include "world/stepper.hpp"
#include "world/world.hpp"

using namespace falling_particles;
using supernormal::test::relative;
namespace fx = supernormal::effects;

namespace {

/// A scene of these walls, and one grain for which there is room far from them.
struct DrivenScene {
  static constexpr double kStepSize = 5e-4;   // s
  static constexpr double kDownwards = 9.81;  // m/s^2

  explicit DrivenScene(std::vector<Wall> walls, bool falls = false)
      : scene(scene_of(Open{{{5, 5, 5}, {0.2, 0.2, 1}}, {{-10, -10, -10}, {30, 30, 30}}}, {{ball(), 1}})) {
    scene.walls = std::move(walls);
    scene.effects.clear();
    if (falls) scene.effects.emplace_back(fx::Gravity{{0, 0, -kDownwards}});
    scene.time = {10, kStepSize, 0.1};
  }
  Scene scene;
};

Wall door() {
  Wall wall{"door", BoxShape{{0.4, 0.02, 0.8}}, {{0.2, 0.1, 0}, Eigen::Quaterniond::Identity()}};
  wall.drive = Drive{Vector3::UnitZ(), 0.5, 0.2};
  wall.drive->point = Vector3(0, 0.1, 0);
  return wall;
}

/// The state of wall 0 after these steps.
WallState after(const Scene& scene, int steps, const std::function<void(const World&)>& each = {}) {
  const World world(scene, {{0, {5, 5, 5}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  for (int i = 0; i < steps; ++i) {
    stepper.step();
    if (each) each(world);
  }
  return world.walls().state(0);
}

double angle_of(const WallState& state) { return 2 * std::atan2(state.pose.rotation.z(), state.pose.rotation.w()); }

}  // namespace

TEST_CASE("a door under a torque T turns by T t^2 / (2 I) about its hinge") {
  constexpr int kSteps = 1500;
  const WallState state = after(DrivenScene({door()}).scene, kSteps);
  const double time = kSteps * DrivenScene::kStepSize;
  const double speed = 0.5 / 0.2 * time;
  const double angle = speed * (time + DrivenScene::kStepSize) / 2;  // the sum of the speeds at the ends of the steps
  CHECK(state.velocity.angular.z() == relative(speed).epsilon(1e-9));
  CHECK(state.velocity.angular.head<2>().norm() < 1e-12);
  CHECK(angle_of(state) == relative(angle).epsilon(1e-9));
  CHECK((state.pose.position - Vector3(0.2 * std::cos(angle), 0.1 + 0.2 * std::sin(angle), 0)).norm() < 1e-9);
  CHECK((state.velocity.linear - state.velocity.angular.cross(state.pose.position - Vector3(0, 0.1, 0))).norm() < 1e-12);
}

TEST_CASE("the surface of a driven wall has the velocity of its drive: about the hinge of a door, along the axis of a piston") {
  const Vector3 point(0.3, 0.11, 0.2);
  Wall piston = door();
  piston.drive = Drive{Vector3::UnitX(), 0.5, 0.2};
  Vector3 of_door, of_piston;
  const auto ask = [&point](Vector3& answer) {
    return [&](const World& world) {
      answer = world.walls().surface_velocity(world.walls().geoms()[0], point, point, Vector3::Zero());
    };
  };
  const WallState turned = after(DrivenScene({door()}).scene, 100, ask(of_door));
  // A grain on a turning wall gets the chord of its step, which differs by up to speed^2 radius step.
  const Vector3 lever = point - Vector3(0, 0.1, 0);
  const double chord = turned.velocity.angular.squaredNorm() * lever.norm() * DrivenScene::kStepSize;
  CHECK((of_door - turned.velocity.angular.cross(lever)).norm() < chord);
  CHECK(chord < 1e-4 * of_door.norm());
  const WallState moved = after(DrivenScene({piston}).scene, 100, ask(of_piston));
  CHECK((of_piston - moved.velocity.linear).norm() < 1e-9);
  CHECK(moved.velocity.linear.x() > 0.1);
}

TEST_CASE("a door stops where its travel ends, and has the terminal speed T / damping before") {
  Wall wall = door();
  wall.drive->damping = 1;
  wall.drive->travel = {-1, 1.5};
  double fastest = 0;
  const WallState state = after(DrivenScene({wall}).scene, 12000, [&fastest](const World& world) {
    fastest = std::max(fastest, world.walls().state(0).velocity.angular.z());
  });
  CHECK(fastest == relative(0.5).epsilon(1e-6));
  CHECK(angle_of(state) == relative(1.5).epsilon(1e-3));
}

TEST_CASE("the joint of a driven part has five rows of the solver in a step, and six at the end of its travel") {
  Wall wall = door();
  const auto rows_in = [](const Scene& scene, int steps) {
    const World world(scene, {{0, {5, 5, 5}, {1, 0, 0, 0}}});
    Stepper stepper(world, scene);
    for (int i = 0; i < steps; ++i) stepper.step();
    return stepper.costs().rows_of_walls;
  };
  CHECK(rows_in(DrivenScene({wall}).scene, 10) == 50);
  wall.drive->force = 0;
  wall.drive->travel = {0, 1};
  CHECK(rows_in(DrivenScene({wall, wall}).scene, 10) == 2 * 60);
  wall.drive.reset();
  CHECK(rows_in(DrivenScene({wall}).scene, 10) == 0);
}

TEST_CASE("no part passes the ends of its travel, however fast it is, and it stays there") {
  Wall turning = door();
  turning.drive->mass = 1e-5;  // kg m^2: it would pass the whole circle in a step
  turning.drive->travel = {-1, 2.9};
  Wall sliding{"piston", BoxShape{{0.1, 0.1, 0.02}}};
  sliding.drive = Drive{Vector3::UnitX(), -1000, 1};
  sliding.drive->travel = {-0.5, 0.1};
  Wall servo = sliding;
  servo.drive->servo = Servo{1000, 1, 50, 0.01};
  for (const double step : {1e-4, 1e-3, 1e-2}) {
    CAPTURE(step);
    const auto last_of = [&](const Wall& wall, const auto& coordinate, double low, double high) {
      Scene scene = DrivenScene({wall}).scene;
      scene.time.step = step;
      const WallState end = after(scene, static_cast<int>(std::lround(0.3 / step)), [&](const World& world) {
        const double now = coordinate(world.walls().state(0));
        CHECK(now >= low - 1e-12);
        CHECK(now <= high + 1e-12);
      });
      CHECK(end.velocity.linear.norm() < 1e-12);
      CHECK(end.velocity.angular.norm() < 1e-12);
      return coordinate(end);
    };
    const auto x_of = [](const WallState& state) { return state.pose.position.x(); };
    CHECK(last_of(turning, angle_of, -1, 2.9) == relative(2.9).epsilon(1e-12));
    CHECK(last_of(sliding, x_of, -0.5, 0.1) == -0.5);
    CHECK(last_of(servo, x_of, -0.5, 0.1) == 0.1);
  }
}

TEST_CASE("damping, and the speed and the stress of a servo, are relative to the motions of the part, whose velocity changes") {
  constexpr double kStep = DrivenScene::kStepSize;
  Wall wall{"lid", BoxShape{{0.1, 0.1, 0.02}}};
  wall.drive = Drive{Vector3::UnitX(), 0, 0.5, 2};
  wall.motions = {{Translation{{1, 0, 0}}, 100 * kStep}};  // m/s
  const double relative_speed = after(DrivenScene({wall}).scene, 300).velocity.linear.x() - 1;
  CHECK(relative_speed == relative(-std::pow(1 + kStep * 2 / 0.5, -200)).epsilon(1e-9));

  wall.drive->servo = Servo{500, 1e-4, 10, 0.01};
  wall.motions = {{Vibration{{0.005, 0, 0}, 5, 0}}};
  int steps = 0;
  after(DrivenScene({wall}).scene, 500, [&](const World& world) {
    const double time = ++steps * kStep;
    const double vibration = 0.005 * std::sin(2 * std::numbers::pi * 5 * time);
    CHECK(world.walls().state(0).pose.position.x() - vibration == relative(0.05 * time).epsilon(1e-9));
    CHECK(std::abs(world.walls().servo_stress(0).value()) < 1e-6);
  });
}

TEST_CASE("a part that hangs on a horizontal axis swings as a pendulum with its mass and moment") {
  Wall wall = door();
  wall.drive = Drive{Vector3::UnitY(), 0, 0.2};
  wall.drive->point = Vector3(0.2, 0, 0.5);
  wall.drive->hung_mass = 1.5;
  constexpr double kAmplitude = 0.02;  // rad, so that the period is that of small swings to 3e-5
  const Eigen::AngleAxisd tilt(kAmplitude, Vector3::UnitY());
  wall.start.position = *wall.drive->point + tilt * Vector3(0, 0, -0.5);
  std::vector<double> passes;  // s
  double before = -1;
  int step = 0;
  after(DrivenScene({wall}, true).scene, 8000, [&](const World& world) {
    const double x = world.walls().state(0).pose.position.x() - 0.2;
    ++step;
    if ((x > 0) != (before > 0)) passes.push_back((step - x / (x - before)) * DrivenScene::kStepSize);
    before = x;
  });
  REQUIRE(passes.size() > 2);
  const double half_period = (passes.back() - passes.front()) / static_cast<double>(passes.size() - 1);
  CHECK(half_period == relative(std::numbers::pi * std::sqrt(0.2 / (1.5 * DrivenScene::kDownwards * 0.5))).epsilon(1e-3));
}

TEST_CASE("a piston with a power P has the speed sqrt(2 P t / m), and one with a limit its largest force at first") {
  Wall wall{"piston", BoxShape{{0.1, 0.1, 0.02}}};
  wall.drive = Drive{Vector3::UnitX(), 1e6, 0.5};
  wall.drive->power = 3;
  constexpr int kSteps = 2000;
  const double time = kSteps * DrivenScene::kStepSize;
  CHECK(after(DrivenScene({wall}).scene, kSteps).velocity.linear.x() == relative(std::sqrt(2 * 3 * time / 0.5)).epsilon(1e-9));
  wall.drive->force = 1;  // N, up to P / F = 3 m/s after 1.5 s
  CHECK(after(DrivenScene({wall}).scene, kSteps).velocity.linear.x() == relative(time / 0.5).epsilon(1e-9));
  wall.drive->damping = 0.4;  // N s/m: the power and the damping balance at sqrt(P / damping)
  wall.drive->force = 10;
  CHECK(after(DrivenScene({wall}).scene, 18000).velocity.linear.x() == relative(std::sqrt(3 / 0.4)).epsilon(1e-3));
}

TEST_CASE("a motor with a power turns a part to the angular velocity sqrt(2 P t / I)") {
  Wall wall = door();
  wall.drive->force = 1e6;
  wall.drive->power = 2;
  CHECK(after(DrivenScene({wall}).scene, 1000).velocity.angular.z() == relative(std::sqrt(2 * 2 * 0.5 / 0.2)).epsilon(1e-9));
}

TEST_CASE("a brick on a turntable that a torque turns keeps its distance from the axis") {
  Wall table{"table", BoxShape{{0.4, 0.4, 0.02}}, {{0, 0, -0.01}, Eigen::Quaterniond::Identity()}};
  table.drive = Drive{Vector3::UnitZ(), 0.8, 0.2};
  table.drive->point = Vector3::Zero();
  table.drive->until = 1;  // s; then it turns with nearly 4 rad/s
  Scene scene = DrivenScene({table}, true).scene;
  scene.kinds = {{{"brick", {0.01, 0.01, 4e-3}, 20, 20, 0, 2000, "test"}, 1}};
  scene.effects.emplace_back(fx::Friction{1, {}});
  scene.effects.emplace_back(fx::SurfaceLayer{1e-5});
  scene.time.step = 2e-3;
  const World world(scene, {{0, {0.05, 0.01, 4e-3}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  const auto distance_after = [&](int steps) {
    for (int i = 0; i < steps; ++i) stepper.step();
    const Point p = world.grains()[0].position();
    return std::hypot(p[0], p[1]);
  };
  const double before = distance_after(600);
  CHECK(world.walls().state(0).velocity.angular.z() > 3.9);
  CHECK(std::abs(distance_after(1000) - before) < 1e-6);
}

namespace {

constexpr double kServoStiffness = 1e5;  // N/m, of the spring between two bodies
constexpr double kTarget = 2000;         // Pa

/// A ball with a spring between a plane at x = 0 and a plane that a servo pushes towards it, with the ball's area between it.
Scene spring_bed(double gain) {
  Wall wall{"servo", PlaneShape{0, -Vector3::UnitX()}, {{0.013, 0, 0}, Eigen::Quaterniond::Identity()}};
  wall.drive = Drive{-Vector3::UnitX(), 0, 0};
  wall.drive->servo = Servo{kTarget, gain, 0.5, 0, {{"y_low", "y_high"}, {"z_low", "z_high"}}};
  const auto side = [](const char* name, const Vector3& normal, const Vector3& position) {
    return Wall{name, PlaneShape{0, normal}, {position, Eigen::Quaterniond::Identity()}};
  };
  Scene scene = DrivenScene({wall, side("x_low", Vector3::UnitX(), {0, 0, 0}), side("y_low", Vector3::UnitY(), {0, -0.02, 0}),
                             side("y_high", -Vector3::UnitY(), {0, 0.03, 0}), side("z_low", Vector3::UnitZ(), {0, 0, -0.03}),
                             side("z_high", -Vector3::UnitZ(), {0, 0, 0.01})})
                    .scene;
  scene.effects.emplace_back(fx::Compliance{kServoStiffness, 5, {}});
  scene.solver.iterations = 400;  // a wall with a small gain is a thousand times heavier than the ball
  return scene;
}

}  // namespace

TEST_CASE("a servo reaches its target on a bed of springs, whose area is between the other walls, and never passes its speed") {
  constexpr double kArea = 0.05 * 0.04;                       // m^2
  const double squeezed = kTarget * kArea / kServoStiffness;  // m, at each side
  for (const double gain : {1e-6, 1e-5, 1e-3, 1.0}) {
    CAPTURE(gain);
    const Scene scene = spring_bed(gain);
    const World world(scene, {{0, {5e-3, 0, 0}, {1, 0, 0, 0}}});
    Stepper stepper(world, scene);
    const double start = world.walls().state(0).pose.position.x();
    double fastest = 0;
    for (int i = 0; i < 20000; ++i) {
      stepper.step();
      fastest = std::max(fastest, world.walls().state(0).velocity.linear.norm());
      if (i == 0) {
        CHECK(std::abs(world.walls().servo_stress(0).value()) < 1e-9 * kTarget);
        CHECK(start - world.walls().state(0).pose.position.x() ==
              relative(std::min(gain * kTarget, 0.5) * scene.time.step).epsilon(1e-9));
      }
    }
    CHECK(fastest <= 0.5);
    const double stress = world.walls().servo_stress(0).value();
    CHECK(stress == relative(kTarget).epsilon(1e-4));
    CHECK(world.walls().state(0).pose.position.x() == relative(0.01 - 2 * squeezed).epsilon(1e-4));
    CHECK(std::abs(-world.walls().state(0).velocity.linear.x() - gain * (kTarget - stress)) < 1e-9);
  }
}

TEST_CASE("the stress of a servo follows the area between walls that move") {
  Scene scene = spring_bed(1e-3);
  scene.walls[3].motions = {{Translation{{0, 0.005, 0}}, 1, 2}};  // y_high: the area grows by a tenth
  const World world(scene, {{0, {5e-3, 0, 0}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  for (int i = 0; i < 6000; ++i) stepper.step();
  CHECK(world.walls().servo_stress(0).value() == relative(kTarget).epsilon(1e-4));
  CHECK(world.walls().driven(0)->load == relative(kTarget * 0.055 * 0.04).epsilon(1e-4));
}

TEST_CASE("a servo whose area has vanished ends the run, with the names of the walls, the time and what would prevent it") {
  Scene scene = spring_bed(1e-3);
  scene.walls[3].motions = {{Translation{{0, -0.3, 0}}, 0.1}};  // y_high meets y_low after 0.2667 s
  const World world(scene, {{0, {5, 5, 5}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  const auto run = [&] {
    for (int i = 0; i < 1000; ++i) stepper.step();
  };
  CHECK_THROWS_WITH_AS(run(),
                       doctest::Contains("\"y_low\" and \"y_high\", which a key \"between\" names, no longer face each other"),
                       std::runtime_error);
  CHECK_THROWS_WITH_AS(stepper.step(), doctest::Contains("after 0.267 s; travel of a drive"), std::runtime_error);
}

TEST_CASE("a servo is held before it starts and after it ends, and its stops bear what the grains do not") {
  Scene scene = spring_bed(1e-3);
  Drive& drive = *scene.walls[0].drive;
  drive.from = 0.5;
  drive.until = 2;
  drive.travel = {0, 0.002};  // 1 mm before the ball
  const World world(scene, {{0, {5e-3, 0, 0}, {1, 0, 0, 0}}});
  Stepper stepper(world, scene);
  const auto place_after = [&](double seconds) {
    for (int i = 0; i < std::lround(seconds / scene.time.step); ++i) stepper.step();
    return world.walls().state(0).pose.position.x();
  };
  CHECK(place_after(0.5) == 0.013);
  CHECK_FALSE(world.walls().servo_stress(0));
  CHECK(place_after(1) == relative(0.011).epsilon(1e-3));
  CHECK(std::abs(world.walls().servo_stress(0).value()) < 1e-6 * kTarget);
  const double end = place_after(0.5);
  CHECK(place_after(0.5) == end);
  CHECK_FALSE(world.walls().servo_stress(0));
}

TEST_CASE("a power adds power times step to the energy in each step, up to its limit at rest") {
  constexpr double kMass = 0.5, kLargest = 100;
  Drive drive{Vector3::UnitX(), kLargest, kMass};
  drive.power = 3;
  for (const double step : {1e-4, 1e-2}) {
    CAPTURE(step);
    CHECK(push_of(drive, 0, 1e-9) == kLargest);
    CHECK(push_of(drive, -2, step) == kLargest);
    for (const double speed : {0.1, 2.0}) {
      const double then = speed + step / kMass * push_of(drive, speed, step);
      CHECK(kMass / 2 * (then * then - speed * speed) == relative(drive.power * step).epsilon(1e-12));
    }
  }
  CHECK(push_of(drive, 2, 1e-9) == relative(drive.power / 2).epsilon(1e-6));
  drive.power = 0;
  CHECK(push_of(drive, 2, 0.1) == kLargest);
}

TEST_CASE("the distance of walls that face each other is that of their nearest parallel faces, however they overlap elsewhere") {
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.3, Vector3(1, 2, 3).normalized()));
  const auto at = [&](double x, double y, double z) { return WallPose{turned * Vector3(x, y, z), turned}; };
  const BoxShape wide{{0.1, 2, 2}}, thin{{0.2, 3, 1}};
  const PlaneShape plane{0, -Vector3::UnitX()};
  const auto boxes = facing_faces(wide, at(0, 0, 0), thin, at(0.7, 0.5, -0.2));
  REQUIRE(boxes);
  CHECK(boxes->distance() == relative(0.7 - 0.05 - 0.1).epsilon(1e-12));
  CHECK((boxes->normal - turned * Vector3::UnitX()).norm() < 1e-15);
  CHECK(boxes->first == relative(0.05).epsilon(1e-12));
  const auto with_plane = facing_faces(plane, at(0.4, 5, 5), wide, at(0, 0, 0));
  REQUIRE(with_plane);
  CHECK(with_plane->distance() == relative(0.35).epsilon(1e-12));
  CHECK(with_plane->second == relative(-0.05).epsilon(1e-12));
  CHECK(facing_faces(wide, at(0, 0, 0), wide, at(0.08, 0, 0))->distance() < 0);
  CHECK_FALSE(facing_faces(plane, at(0, 0, 0), plane, at(1, 0, 0)));
  CHECK_FALSE(facing_faces(wide, at(0, 0, 0), wide, {Vector3(0.7, 0, 0), Eigen::Quaterniond::Identity()}));
  CHECK_FALSE(facing_faces(wide, at(0, 0, 0), CylinderShape{1, 1}, at(3, 0, 0)));
}
