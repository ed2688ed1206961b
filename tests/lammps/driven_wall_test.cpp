// Walls that forces move, and the clock of a run with a changing step.
#include "kernel/walls/driven_wall.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/relative.hpp"

using namespace granular;
using common::Drive;
using common::Servo;
using common::WallPose;
using supernormal::test::relative;

namespace {

/// Moves a wall by `steps` steps (s) under forces on it, given by its pose.
void run(DrivenWall& wall, const WallPose& carrier, const Vector3& gravity, double step, int steps, auto force_at) {
  for (int i = 0; i < steps; ++i) {
    wall.kick(carrier, gravity, (i + 0.25) * step, step);
    wall.drift(step);
    wall.load(carrier, force_at(wall.pose_on(carrier)), Vector3::Zero());
    wall.kick(carrier, gravity, (i + 0.75) * step, step);
  }
}

Vector3 none(const WallPose& /*pose*/) { return Vector3::Zero(); }

Drive sliding(const Vector3& axis, double force, double mass) {
  Drive drive{};
  drive.axis = axis.normalized();
  drive.force = force;
  drive.mass = mass;
  return drive;
}

void advance(Clock& clock, int steps, double step) {
  for (int i = 0; i < steps; ++i) clock.advance(step);
}

}  // namespace

TEST_CASE("lammps: a driven wall falls along its axis, by force and weight") {
  const WallPose start{Vector3(1, 2, 3)};
  const Drive drive = sliding({0, 3, -4}, 2, 0.5);
  DrivenWall wall(drive, start);
  run(wall, start, {0, 0, -10}, 1e-3, 1000, none);
  const double acceleration = 2 / 0.5 + 10 * 0.8;
  CHECK(wall.state().speed == relative(acceleration).epsilon(1e-12));
  CHECK(wall.state().position == relative(acceleration / 2).epsilon(1e-12));
  CHECK((wall.pose_on(start).position - start.position - wall.state().position * drive.axis).norm() < 1e-12);
}

TEST_CASE("lammps: damping leaves the terminal speed for any step, and times hold and release a wall") {
  for (const double step : {1e-4, 0.01, 10.0}) {
    Drive drive = sliding({1, 0, 0}, 6, 0.1);
    drive.damping = 3;
    drive.from = 50 * step;
    DrivenWall wall(drive, {});
    run(wall, {}, Vector3::Zero(), step, 50, none);
    CHECK(wall.state().position == 0);
    drive.from = 0;
    const int steps = static_cast<int>(std::lround(2 / step)) + 100;
    drive.until = 2 * steps * step;
    DrivenWall released(drive, {});
    run(released, {}, Vector3::Zero(), step, steps, none);
    CHECK(released.state().speed == relative(2.0).epsilon(1e-9));
    drive.until = 1e-9 * step;
    DrivenWall left(drive, {});
    left.restore({0, 2, 0, 0});
    run(left, {}, Vector3::Zero(), step, steps, none);
    CHECK(std::abs(left.state().speed) < 1e-9);
  }
}

TEST_CASE("lammps: a hanging wall swings with the period of a pendulum, and stops at the ends of its travel") {
  const double mass = 2, length = 0.5, gravity = 9.81, step = 1e-4, amplitude = 1e-3;
  Drive drive = sliding({0, 1, 0}, 0, mass * length * length);
  drive.point = Vector3(0, 0, 1);
  drive.hung_mass = mass;
  // Beside the point by a small angle.
  const WallPose start{Vector3(length * std::sin(amplitude), 0, 1 - length * std::cos(amplitude))};
  const int half = static_cast<int>(std::lround(std::numbers::pi * std::sqrt(length / gravity) / step));
  DrivenWall free(drive, start);
  run(free, start, {0, 0, -gravity}, step, half, none);
  CHECK(free.state().position == relative(2 * amplitude).epsilon(1e-4));
  CHECK(free.pose_on(start).position.x() == relative(-start.position.x()).epsilon(1e-4));
  drive.travel = {0, amplitude};
  DrivenWall stopped(drive, start);
  run(stopped, start, {0, 0, -gravity}, step, half, none);
  CHECK(stopped.state().position == amplitude);
  CHECK(stopped.state().speed == 0);
}

TEST_CASE("lammps: a servo on a spring reaches its stress, no faster than its largest speed") {
  Drive drive{};
  drive.axis = -Vector3::UnitZ();
  drive.servo = Servo{1e3, 1e-4, 0.05, 0.01};
  const double spring = 1e4;  // N/m
  DrivenWall wall(drive, {});
  double fastest = 0;
  const auto force = [&](const WallPose& pose) {
    fastest = std::max(fastest, std::abs(wall.state().speed));
    return Vector3(0, 0, -spring * pose.position.z());
  };
  run(wall, {}, Vector3::Zero(), 1e-4, 3000, force);
  CHECK(fastest == 0.05);
  CHECK(wall.stress() == relative(1e3).epsilon(1e-9));
  CHECK(wall.state().push == relative(10.0).epsilon(1e-12));
}

TEST_CASE("lammps: a drive goes with the motions of its wall") {
  Drive drive = sliding({1, 0, 0}, 1, 1);
  DrivenWall wall(drive, {});
  wall.restore({0.2, 3, 0, 0});
  const WallPose carrier{Vector3(5, 0, 0), Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitZ()))};
  CHECK((wall.pose_on(carrier).position - Vector3(5, 0.2, 0)).norm() < 1e-12);
  const auto velocity = wall.velocity_on(carrier, {Vector3(1, 0, 0), Vector3(0, 0, 2)});
  CHECK((velocity.linear - Vector3(1 - 0.4, 3, 0)).norm() < 1e-12);
  CHECK((velocity.angular - Vector3(0, 0, 2)).norm() < 1e-12);
}

TEST_CASE("lammps clock: the time is a product while the step is constant, and a sum of products when it changes") {
  Clock clock;
  CHECK(clock.now() == 0);
  advance(clock, 8000, 1e-5);
  CHECK(clock.now() == 8000 * 1e-5);
  advance(clock, 4000, 5e-6);
  CHECK(clock.now() == 8000 * 1e-5 + 4000 * 5e-6);
  advance(clock, 1, 1e-5);
  CHECK(clock.now() == doctest::Approx(0.10001).epsilon(1e-14));
}

TEST_CASE("lammps clock: a clock resumed from saved data has the same time to the bit") {
  Clock whole;
  advance(whole, 1000, 0.1);
  advance(whole, 333, 0.07);
  Clock again(whole.state());
  CHECK(again.now() == whole.now());
  advance(whole, 100, 0.07);
  advance(again, 100, 0.07);
  CHECK(again.now() == whole.now());
}
