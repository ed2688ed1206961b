// Tests of prescribed motions: the pose is a function of time alone, and the velocities lead to it.
#include "common/motion.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace common;

namespace {

double distance(const WallPose& a, const WallPose& b) {
  return (a.position - b.position).norm() + a.rotation.angularDistance(b.rotation);
}

WallPose pose(const Vector3& position) { return {position, Eigen::Quaterniond::Identity()}; }

/// A part that shakes and turns about an axis beside it, while a second turn carries both.
std::vector<WallMotion> busy() {
  return {{Rotation{Vector3::UnitZ(), {0.1, 0, 0}, 40}},
          {Vibration{{0, 0, 0.01}, 25, 0.3}},
          {Rotation{Vector3::UnitX(), {0, 0.05, 0}, -90}, 0.2, 1.7},
          {Translation{{0.1, 0, 0.2}}, 0.5}};
}

}  // namespace

TEST_CASE("the rotation between two directions is the smallest, also between opposite ones") {
  const Vector3 up = Vector3::UnitZ();
  for (const Vector3& from :
       {Vector3(0, 0, 1), Vector3(0, 0, -2), Vector3(1, 0, 0), Vector3(0, 3, 0), Vector3(0.6, 0, 0.8), Vector3(-1, 2, 0.5)}) {
    const Vector3 across = from.cross(Vector3(0.3, -0.5, 0.7));
    // Tilts from the opposite direction, in rad: no digits are lost where the directions are almost opposite.
    for (const Vector3& to : {up, from, Vector3(-from), Vector3(-from + 1e-9 * across), Vector3(-from + 1e-5 * across)}) {
      const Eigen::Quaterniond rotation = rotation_between(from, to);
      CHECK((rotation * from.normalized() - to.normalized()).norm() < 1e-10);
      const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
      CHECK(rotation.norm() == doctest::Approx(1).epsilon(1e-12));
      CHECK(rotation.angularDistance(Eigen::Quaterniond::Identity()) == doctest::Approx(angle).epsilon(1e-7));
    }
  }
}

TEST_CASE("a drum has its first pose after any number of whole revolutions") {
  const WallPose start{{0.3, 0.2, 0.1}, Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()))};
  const std::vector<WallMotion> motions = {{Rotation{Vector3::UnitY(), {0.25, 0, 0.4}, 30}}};
  for (const double turns : {1.0, 7.0, 1000.0}) CHECK(distance(pose_at(start, motions, 2 * turns), start) < 1e-15);
  // A quarter of a turn about y leads from z to x.
  const WallPose quarter = pose_at(start, motions, 0.5);
  CHECK((quarter.position - Vector3(0.25 - 0.3, 0.2, 0.4 - 0.05)).norm() < 1e-15);
}

TEST_CASE("a motion acts from its start to its end, and then the wall stays") {
  const std::vector<WallMotion> motions = {{Translation{{1, 0, 0}}, 0.5, 0.75}};
  CHECK(pose_at(pose({0, 0, 0}), motions, 0.5).position.x() == 0);
  CHECK(pose_at(pose({0, 0, 0}), motions, 0.625).position.x() == 0.125);
  CHECK(pose_at(pose({0, 0, 0}), motions, 9).position.x() == 0.25);
}

TEST_CASE("a vibration starts where the part is, and has its amplitude, frequency and phase") {
  const std::vector<WallMotion> motions = {{Vibration{{0, 0, 0.002}, 50, std::numbers::pi / 2}}};
  const WallPose start = pose({1, 2, 3});
  CHECK(distance(pose_at(start, motions, 0), start) == 0);
  for (const double time : {0.003, 0.01, 1.234}) {
    const double z = 3 + 0.002 * (std::sin(2 * std::numbers::pi * 50 * time + std::numbers::pi / 2) - 1);
    CHECK(pose_at(start, motions, time).position.z() == doctest::Approx(z).epsilon(1e-12));
  }
}

TEST_CASE("displacements and earlier rotations move the axis of a rotation") {
  // A wheel on an arm: the arm turns by a quarter about z, the wheel by a quarter about its own axis, which was x.
  const std::vector<WallMotion> motions = {
      {Rotation{Vector3::UnitZ(), {0, 0, 0}, 15}}, {Rotation{Vector3::UnitX(), {1, 0, 0}, 15}}, {Translation{{0, 0, 5}}}};
  const WallPose end = pose_at(pose({1, 0, 0}), motions, 1);
  CHECK((end.position - Vector3(0, 1, 5)).norm() < 1e-15);
  CHECK((end.rotation * Vector3::UnitX() - Vector3::UnitY()).norm() < 1e-15);
  CHECK((end.rotation * Vector3::UnitY() - Vector3::UnitZ()).norm() < 1e-15);
}

TEST_CASE(
    "a grain that rides on a wall gets the velocity of its chord; a grain that stands gets the velocity of the wall at its place") {
  const WallPose start{{0.3, 0.2, 0.1}, Eigen::Quaterniond(Eigen::AngleAxisd(2.5, Vector3(1, 2, 3).normalized()))};
  const std::vector<WallMotion> motions = busy();
  for (const double step : {1e-5, 1e-3, 0.05}) {
    for (const double time : {0.1, 0.8, 3.0}) {
      CAPTURE(step);
      CAPTURE(time);
      const WallPose now = pose_at(start, motions, time);
      const WallPose next = pose_at(start, motions, time + step);
      const WallVelocity rigid = mean_velocity(now, next, step);
      const auto excess = chord_excess(start, now, next, motions, time, time + step);
      REQUIRE(excess);
      const Vector3 point(0.5, -0.4, 0.3);  // of the part
      const Vector3 lever = now(point) - now.position;
      const Vector3 chord = (next(point) - now(point)) / step;
      const Vector3 ridden = now.rotation * next.rotation.conjugate() * chord;  // what the last step has left, if motions last
      CHECK((rigid.linear + rigid.angular.cross(lever) + excess->at(lever, ridden) - chord).norm() < 1e-15 / step + 1e-13);
      const double turned = step * rigid.angular.norm();
      CHECK(excess->at(lever, Vector3::Zero()).norm() <
            1e-15 / step + 0.2 * turned * turned * chord.norm() + turned * rigid.linear.norm());
    }
  }
  const std::vector<WallMotion> straight = {{Translation{{0.1, 0, 0.2}}}, {Vibration{{0, 0, 0.01}, 25, 0.3}}};
  CHECK(!chord_excess(start, pose_at(start, straight, 0.1), pose_at(start, straight, 0.2), straight, 0.1, 0.2));
}

TEST_CASE("the mean velocity of a step leads from pose to pose") {
  const WallPose start{{0.3, 0.2, 0.1}, Eigen::Quaterniond(Eigen::AngleAxisd(2.5, Vector3(1, 2, 3).normalized()))};
  const std::vector<WallMotion> motions = busy();
  for (const double step : {1e-6, 1e-3, 0.05}) {
    for (const double time : {0.0, 0.19, 0.5, 1.68, 3.0}) {
      const WallPose now = pose_at(start, motions, time);
      const WallPose next = pose_at(start, motions, time + step);
      const WallVelocity v = mean_velocity(now, next, step);
      const double angle = step * v.angular.norm();
      WallPose moved = now;
      moved.position += step * v.linear;
      if (angle > 0) moved.rotation = Eigen::AngleAxisd(angle, v.angular.normalized()) * moved.rotation;
      CHECK(distance(moved, next) < 1e-14);
    }
  }
}

TEST_CASE("a mean velocity keeps its digits in small steps") {
  const std::vector<WallMotion> motions = {{Rotation{Vector3(1, -2, 2).normalized(), {0, 0, 0}, 6}}};
  const WallVelocity v = mean_velocity(pose_at({}, motions, 1.0), pose_at({}, motions, 1.00001), 1e-5);
  CHECK((v.angular - 0.2 * std::numbers::pi * Vector3(1, -2, 2).normalized()).norm() < 1e-9);
}

TEST_CASE("the surface of a conveyor moves while the wall stands; its velocity rotates with the wall") {
  const std::vector<WallMotion> belt = {{Conveyor{{2, 0, 0}, {Vector3::UnitZ(), {0, 0, 0}, 0}}, 0.5, 1.5}};
  const WallPose start = pose({1, 0, 0});
  CHECK(distance(pose_at(start, belt, 1), start) == 0);
  CHECK(conveyor_velocity(start, start, belt, 0.2, 0.3).is_zero());
  CHECK(conveyor_velocity(start, start, belt, 0.7, 0.8).linear.x() == doctest::Approx(2));
  CHECK(conveyor_velocity(start, start, belt, 0.4, 0.6).linear.x() == doctest::Approx(1));  // half of the step
  const std::vector<WallMotion> turning = {{Rotation{Vector3::UnitZ(), {1, 0, 0}, 15}}, belt[0]};
  CHECK((conveyor_velocity(start, pose_at(start, turning, 1), turning, 1, 1.1).linear - Vector3(0, 2, 0)).norm() < 1e-14);
}

TEST_CASE("the surface of a drum turns about its axis") {
  const std::vector<WallMotion> drum = {{Conveyor{{0, 0, 0}, {Vector3::UnitY(), {0, 0, 0.1}, 60}}}};
  const WallPose start = pose({0.2, 0, 0.1});
  const WallVelocity v = conveyor_velocity(start, start, drum, 0, 1e-3);
  CHECK((v.angular - 2 * std::numbers::pi * Vector3::UnitY()).norm() < 1e-14);
  const Vector3 lowest(0, 0, 0);
  CHECK((v.linear + v.angular.cross(lowest - start.position) - Vector3(-0.2 * std::numbers::pi, 0, 0)).norm() < 1e-14);
}
