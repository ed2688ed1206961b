// Straight sides on flat ground and on each other: their geometry, the gradient of their energy, bodies that rest on them, and the
// searches and the fading behind them.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "flat_bodies.hpp"
#include "kernel/face_contact.hpp"
#include "kernel/fading.hpp"
#include "kernel/maximum_on_arc.hpp"
#include "support/relative.hpp"

using namespace granular;
using namespace granular::test;
using supernormal::test::relative;

TEST_CASE("lammps: bodies have sides where they are flat along one axis") {
  CHECK(ParticleShape(kBrick, 2, 2).sides.empty());
  CHECK(ParticleShape(kBrick, 8, 8).sides.empty());
  CHECK(ParticleShape(kBrick, 2, 20).sides.size() == 1);
  CHECK(ParticleShape(kBrick, 20, 2).sides.size() == 2);
  Random random{std::mt19937(8)};
  for (const auto& [delta, epsilon] :
       {std::pair(2.0, 20.0), std::pair(3.0, 8.0), std::pair(20.0, 2.0), std::pair(8.0, 3.0), std::pair(1.5, 60.0)}) {
    const ParticleShape shape(kBrick, delta, epsilon);
    REQUIRE(!shape.sides.empty());
    for (const Side& side : shape.sides) {
      CHECK(side.bulge > 0);
      CHECK(side.bulge < 3e-3 * kBrick.minCoeff());
      for (int i = 0; i < 1000; ++i) {
        // A normal across the side, and tilted.
        Vector3 normal = random.vector(1);
        normal[side.along] = 0;
        if (side.across != side.along) normal[side.across] = std::max(1e-3, std::abs(normal[side.across]));
        const double tilt = random(-1, 1) * side.tilt;
        normal[side.along] = std::tan(tilt) * side.part_across(normal);
        normal.normalize();
        const Side::End end = side.end(normal, tilt > 0 ? 1 : -1);
        CHECK(end.point.dot(normal) == relative(end.support).epsilon(1e-12));
        CHECK(end.point.norm() <= shape.bounding_radius * (1 + 1e-12));
        CHECK(end.support <= shape.body.support(normal) + side.bulge * (1 + 1e-9));
        CHECK(end.support >= shape.body.support(normal) * (1 - 1e-12));
      }
    }
  }
}

TEST_CASE("lammps: forces of a side on a plane are the derivatives of the energy") {
  Random random{std::mt19937(9)};
  for (int i = 0; i < 200; ++i) {
    const bool is_can = i % 4 < 2;
    Particle body{kBrick, is_can ? random(1.5, 3.5) : random(8, 30), is_can ? random(8, 30) : random(1.5, 3.5)};
    const Eigen::Quaterniond rolled(Eigen::AngleAxisd(random(-3, 3), Vector3::Unit(is_can ? 2 : 1)));
    check_slopes(body, tilted(random(0, 0.3), random) * kLies * rolled, sticky(i));
  }
}

TEST_CASE("lammps: a body that drops on its side rests along a line, and rolls if nothing resists") {
  for (const auto& exponents : {std::pair(2.0, 20.0), std::pair(2.0, 8.0), std::pair(3.0, 60.0)}) {
    const double delta = exponents.first, epsilon = exponents.second;
    for (const double rolling_length : {0.0, 1e-3}) {
      Floor floor;
      Particle can({0.01, 0.012, 0.02}, delta, epsilon);
      const ContactMaterial material =
          prepared({.stiffness = 2e4, .restitution = 0.3, .friction = 0.5, .rolling_length = rolling_length});
      can.place({0, 0, 0.012}, Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Vector3(0.2, 1, 0.2).normalized())) * kLies);
      WallForce last;
      for (int i = 0; i < 100000; ++i) floor.advance(can, material, 1e-5, 9.81, last);
      CAPTURE(delta);
      CAPTURE(epsilon);
      const double tilt = std::abs(can.body.pose.rotation.col(2).z());
      if (rolling_length > 0) {
        CHECK(can.kinetic_energy() < 1e-18);
        CHECK(last.force.z() == relative(can.mass * 9.81).epsilon(1e-9));
        CHECK(tilt < 1e-4);  // resistance to rolling also holds a small tilt
      } else {
        CHECK(tilt < 1e-10);
      }
    }
  }
}

TEST_CASE("lammps: a level can has the whole stiffness, and one on its rim half of it") {
  Floor floor;
  Particle can({0.01, 0.01, 0.02}, 2, 60);
  const ContactMaterial material = prepared({.stiffness = 1e5});
  const auto place = [&](double tilt, double depth) {
    const double reach = can.shape->sides.at(0).reach;
    can.place({0, 0, std::cos(tilt) * 0.01 + std::sin(tilt) * reach - depth},
              Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2 + tilt, Vector3::UnitY())));
  };
  place(0, 1e-5);
  CHECK(floor.find(can, material, 0).force.z() == relative(1).epsilon(1e-9));
  CHECK(floor.find(can, material, 0).torque.norm() < 1e-12);
  place(2e-3, 1e-5);
  CHECK(floor.find(can, material, 0).force.z() == relative(0.5).epsilon(1e-6));
}

namespace {

/// A body with a side: a can, or a body with a boxy outline and a round profile.
Particle with_side(bool is_can, Random& random) {
  return {{0.01, 0.012, 0.02}, is_can ? random(1.5, 3.5) : random(8, 30), is_can ? random(8, 30) : random(1.5, 3.5)};
}

/// A body on its side, on a brick, tilted by up to `tilt` (rad). Its line may hang over. Either may be the first body.
TwoBodies side_on_face(Random& random, double tilt, const ContactMaterial& material) {
  const bool is_can = random(0, 1) < 0.5;
  const Eigen::Quaterniond rolled(Eigen::AngleAxisd(random(-3, 3), Vector3::Unit(is_can ? 2 : 1)));
  const Eigen::Quaterniond lies = is_can ? Eigen::Quaterniond(kLies * rolled) : rolled;
  TwoBodies pair{{kBrick, random(6, 30), random(6, 30)}, with_side(is_can, random), prepared(material)};
  pair.second.place(Vector3::Zero(), tilted(random(0, tilt), random) * lies);
  const Vector3 aside{random(-0.018, 0.018), random(-0.014, 0.014), 0};
  lower(pair, random.attitude(), aside, random);
  return random(0, 1) < 0.5 ? pair : TwoBodies{pair.second, pair.first, pair.material};
}

/// Two cans whose axes are parallel but for `tilt` (rad), side on side.
TwoBodies side_on_side(Random& random, double tilt, const ContactMaterial& material) {
  TwoBodies pair{with_side(true, random), with_side(true, random), prepared(material)};
  const auto roll = [&] { return Eigen::Quaterniond(Eigen::AngleAxisd(random(-3, 3), Vector3::UnitZ())); };
  const Eigen::Quaterniond flip(Eigen::AngleAxisd(random(0, 1) < 0.5 ? 0 : std::numbers::pi, Vector3::UnitX()));
  const Eigen::Quaterniond little(Eigen::AngleAxisd{random(0, tilt), random.vector(1).normalized()});
  pair.first.place(Vector3::Zero(), kLies * roll());
  pair.second.place(Vector3::Zero(), little * kLies * flip * roll());
  const Vector3 aside{random(-0.03, 0.03), random(-0.004, 0.004), 0};
  lower(pair, random.attitude(), aside, random);
  return pair;
}

}  // namespace

TEST_CASE("lammps: forces of a side on a face are the derivatives of the energy") { check_pair_slopes(side_on_face, 11, 0.15, 1); }

TEST_CASE("lammps: forces of two sides are the derivatives of the energy") { check_pair_slopes(side_on_side, 11, 0.1, 1); }

TEST_CASE("lammps: exchanging two bodies exchanges the forces of their sides, and each has the opposite moment") {
  check_exchange(side_on_face, 12, 1e-9);
  check_exchange(side_on_side, 12, 1e-9);
}

TEST_CASE("lammps: tumbling cans keep their energy through an impact on a brick or a can") {
  check_energy(side_on_face, 13);
  check_energy(side_on_side, 13);
}

TEST_CASE("lammps: a can on a face or on a can has the force on a plane: all of the stiffness, and half of it on one end") {
  const ContactMaterial material = prepared({.stiffness = 1e5});
  Particle can({0.01, 0.01, 0.02}, 2, 60);
  const double reach = can.shape->sides.at(0).reach, depth = 1e-5;
  TwoBodies on_brick{{{0.05, 0.05, 0.01}, 60, 60}, can, material}, on_can{{{0.01, 0.01, 0.03}, 2, 60}, can, material};
  on_can.first.place(Vector3::Zero(), kLies);
  for (TwoBodies* pair : {&on_brick, &on_can}) {
    for (const double tilt : {0.0, 2e-3}) {
      pair->second.place({0, 0, 0.01 + std::cos(tilt) * 0.01 + std::sin(tilt) * reach - depth},
                         Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vector3::UnitY())) * kLies);
      const PairContact contact = pair->find(0);
      CHECK(contact.force.normal == relative(tilt == 0 ? 1 : 0.5).epsilon(1e-5));
      CHECK(std::abs(contact.torque2().y()) == doctest::Approx(tilt == 0 ? 0 : 0.5 * reach).epsilon(2e-3));
    }
  }
}

TEST_CASE("lammps: the common line of two cans ends where the first one ends") {
  const ContactMaterial material = prepared({.stiffness = 1e5});
  TwoBodies pair{{{0.01, 0.01, 0.02}, 2, 60}, {{0.01, 0.01, 0.03}, 2, 60}, material};
  pair.first.place(Vector3::Zero(), kLies);
  pair.second.place({0.02, 0, 0.02 - 1e-5}, kLies);
  const auto line = find_side_pair_contact(pair.first.body, pair.second.body, Vector3::UnitZ());
  REQUIRE(line);
  REQUIRE(line->count == 2);
  CHECK(line->share == 1);
  CHECK(line->corners[0].point.x() + line->corners[1].point.x() ==
        relative(0.02 - pair.second.shape->sides[0].reach + pair.first.shape->sides[0].reach).epsilon(1e-9));
}

TEST_CASE("lammps: cans that cross touch in a point, and the line fades in between without a jump") {
  const ContactMaterial material = prepared({.stiffness = 1e5});
  TwoBodies pair{{{0.01, 0.01, 0.03}, 2, 20}, {{0.01, 0.01, 0.03}, 2, 20}, material};
  pair.first.place(Vector3::Zero(), kLies);
  double last_share = 1, last_force = 1;
  for (int k = 0; k <= 6000; ++k) {
    pair.second.place({0, 0, 0.02 - 1e-5}, Eigen::Quaterniond(Eigen::AngleAxisd(1e-5 * k, Vector3::UnitZ())) * kLies);
    const auto line = find_side_pair_contact(pair.first.body, pair.second.body, Vector3::UnitZ());
    const double share = line ? line->share : 0, force = pair.find(0).force.normal;
    CHECK(share <= last_share);
    CHECK(std::abs(force - last_force) < 1e-3);
    // In between the ends are less deep than the middle.
    CHECK(force > 0.7);
    last_share = share;
    last_force = force;
  }
  CHECK(last_share == 0);
  CHECK(last_force == relative(1).epsilon(1e-3));
}

TEST_CASE("lammps: a body that stands on the pole of its round sides touches in a point") {
  const ContactMaterial material = prepared({.stiffness = 1e5});
  for (const double epsilon : {1.5, 2.0, 3.9}) {
    Particle pillow(kBrick, 20, epsilon);
    for (const double tilt : {0.0, 1e-160, 1e-12}) {
      Floor floor;
      pillow.place({0, 0, kBrick.z() - 1e-5}, Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vector3::UnitX())));
      const WallForce force = floor.find(pillow, material, 0);
      CHECK(force.force.z() == relative(1).epsilon(1e-6));
      CHECK(force.torque.norm() < 1e-5);
      TwoBodies pair{{{0.05, 0.05, 0.01}, 60, 60}, pillow, material};
      pair.second.place({0, 0, 0.01 + kBrick.z() - 1e-5}, pillow.attitude);
      CHECK(pair.find(0).force.force.z() == relative(-1).epsilon(1e-6));
    }
  }
}

TEST_CASE("lammps: rolling over a flat spot of its outline, a can beside a border gets a torque without a spike") {
  for (const double delta : {2.5, 3.0, 3.9}) {
    const Particle can({0.01, 0.012, 0.02}, delta, 20);
    const std::array<Vector2, 4> half_plane{Vector2(-1, -1), Vector2(0, -1), Vector2(0, 1), Vector2(-1, 1)};
    const Patch patch(half_plane);
    Ground ground = Ground::plane(Vector3::Zero(), Vector3::UnitZ());
    ground.frame.setIdentity();
    ground.patches = {&patch, 1};
    double largest = 0;  // 1/rad
    for (int k = -1000; k <= 1000; ++k) {
      Particle rolled = can;
      rolled.place({0, 0, 0.0119}, Eigen::Quaterniond(Eigen::AngleAxisd(2e-4 * k, Vector3::UnitY())) *
                                       Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitX())));
      const auto line = find_side_contact(rolled.body, ground);
      if (!line) continue;
      CHECK(line->share_by_turn.allFinite());
      largest = std::max(largest, std::abs(line->share_by_turn.y()));
    }
    CAPTURE(delta);
    CHECK(largest > 10);
    CHECK(largest < 1000);
  }
}

namespace {

/// The derivatives of cos(angle - top), and how often they were asked for.
struct Cosine {
  double top;
  int* evaluations;
  ArcSlope operator()(double angle) const {
    ++*evaluations;
    return {-std::sin(angle - top), -std::cos(angle - top)};
  }
};

/// A roof with a sharp ridge: the slope jumps, and the second derivative is no help.
ArcSlope roof(double angle) { return {angle < 0.3 ? 1.0 : -2.0, 0}; }

}  // namespace

TEST_CASE("lammps: the maximum of a cosine is found to rounding, by Newton's method") {
  for (const double top : {-0.9, -1e-7, 0.0, 0.123, 0.99}) {
    int evaluations = 0;
    CHECK(std::abs(find_maximum_on_arc(Cosine{top, &evaluations}, -1, 1) - top) < 1e-14);
    CHECK(evaluations <= 10);
  }
}

TEST_CASE("lammps: the uphill search finds a maximum up to half a turn away, on either side") {
  for (const double top : {-3.0, -1.5, -0.02, -1e-9, 0.0, 1e-9, 0.3, 1.6, 3.1}) {
    int evaluations = 0;
    CHECK(std::abs(find_maximum_uphill(Cosine{top, &evaluations}) - top) < 1e-14);
    CHECK(evaluations <= 16);
  }
}

TEST_CASE("lammps: a sharp ridge is found by bisection") {
  CHECK(std::abs(find_maximum_on_arc(roof, 0, 1) - 0.3) < 1e-13);
  CHECK(std::abs(find_maximum_uphill(roof) - 0.3) < 1e-13);
}

TEST_CASE("lammps: a slope that is only rounding, and a curvature that is infinite, leave the start") {
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(find_maximum_uphill([](double angle) { return ArcSlope{1e-300 - angle, -1}; }) == doctest::Approx(0).epsilon(1e-14));
  CHECK(std::abs(find_maximum_uphill([&](double angle) { return ArcSlope{angle > 0 ? -1.0 : 1e-18, -infinite}; })) < 1e-13);
}

TEST_CASE("lammps: a ramp is 0 up to 0, 1 from 1 on, and a cubic with level ends in between") {
  for (const double x : {-2.0, 0.0, 1.0, 7.0}) {
    CHECK(Ramp(x).value == (x > 0.5 ? 1 : 0));
    CHECK(Ramp(x).slope == 0);
  }
  CHECK(Ramp(0.5).value == 0.5);
  CHECK(Ramp(0.5).slope == 1.5);
  for (const double x : {0.1, 0.3, 0.8}) {
    CHECK(Ramp(x).value + Ramp(1 - x).value == relative(1).epsilon(1e-15));
    CHECK((Ramp(x + 1e-6).value - Ramp(x - 1e-6).value) / 2e-6 == relative(Ramp(x).slope).epsilon(1e-8));
  }
}

TEST_CASE("lammps: opposite faces count in full up to the largest tilt, half at 1.5 times, and not at all from twice on") {
  const double largest = 0.2;
  const Vector3 axis = Vector3(1, 2, -0.5).normalized(), normal2 = axis.unitOrthogonal();
  const auto tilt = [&](double angle) { return Tilt(Eigen::AngleAxisd(angle, axis) * -normal2, normal2, largest); };
  for (const auto& [angle, share] : {std::pair(0.0, 1.0), std::pair(0.199, 1.0), std::pair(0.3, 0.5), std::pair(0.401, 0.0)}) {
    CHECK(tilt(angle).share == doctest::Approx(share).epsilon(1e-14));
    CHECK(tilt(-angle).share == doctest::Approx(share).epsilon(1e-14));
    if (angle != 0.3) CHECK(tilt(angle).by_turn == Vector3::Zero());
  }
  // Faces that look the same way.
  CHECK(Tilt(normal2, normal2, largest).share == 0);
  // The derivative is along the axis of the tilt, and odd in it.
  for (const double angle : {-0.3, 0.25, 0.37}) {
    const double slope = (tilt(angle + 1e-6).share - tilt(angle - 1e-6).share) / 2e-6;
    CHECK((tilt(angle).by_turn - slope * axis).norm() < 1e-8);
  }
}
