// Faces that meet: their geometry, the gradient of their energy, and bodies that rest on them.
#include "kernel/face_contact.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "kernel/walls/plane_wall.hpp"
#include "kernel/walls/wall_contacts.hpp"
#include "samples/lammps/two_bodies.hpp"
#include "support/relative.hpp"

using namespace granular;
using namespace granular::test;
using supernormal::test::relative;

namespace {

const Vector3 kBrick(0.02, 0.015, 0.01);  // m

struct Random {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vector3 vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  Eigen::Quaterniond attitude() {
    return Eigen::Quaterniond((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1)).normalized();
  }
};

/// A rotation that brings an axis of the body to z.
Eigen::Quaterniond face_up(int axis) { return Eigen::Quaterniond::FromTwoVectors(Vector3::Unit(axis), Vector3::UnitZ()); }

/// A small rotation about a horizontal axis after any rotation about z.
Eigen::Quaterniond tilted(double tilt, Random& random) {
  const double direction = random(0, 2 * std::numbers::pi);
  return Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vector3(std::cos(direction), std::sin(direction), 0))) *
         Eigen::Quaterniond(Eigen::AngleAxisd(random(0, 2 * std::numbers::pi), Vector3::UnitZ()));
}

/// Two boxy bodies whose faces overlap in part, tilted by up to `tilt` (rad), in any orientation.
TwoBodies facing(Random& random, double tilt, const ContactMaterial& material) {
  TwoBodies pair{{kBrick, random(6, 30), random(6, 30)}, {{0.012, 0.018, 0.012}, random(6, 60), random(6, 60)}, prepared(material)};
  const int axis1 = static_cast<int>(random(0, 2.999)), axis2 = static_cast<int>(random(0, 2.999));
  const Eigen::Quaterniond world = random.attitude();
  const Eigen::Quaterniond attitude2 = tilted(random(0, tilt), random) * face_up(axis2);
  const Vector3 aside(random(-0.01, 0.01), random(-0.01, 0.01), 0);
  pair.first.place(Vector3::Zero(), world * tilted(0, random) * face_up(axis1));
  double height = 0.05;
  const auto place = [&] { pair.second.place(world * Vector3(aside + height * Vector3::UnitZ()), world * attitude2); };
  place();
  while (pair.find(0).state != PairState::Touching) {
    height -= 1e-4;
    place();
  }
  height -= random(0, 2e-4);
  place();
  return pair;
}

struct Floor {
  PlaneWall wall{Vector3::Zero(), Vector3::UnitZ()};
  Body body;
  WallHistory history;
  std::vector<WallContact> contacts;

  WallForce find(const Particle& particle, const ContactMaterial& material, double step) {
    return find_wall_force(wall, body, *particle.shape, particle.body, material, step, history, contacts);
  }
  /// A step with gravity. `last` is the force before and after it.
  void advance(Particle& particle, const ContactMaterial& material, double step, double gravity, WallForce& last) {
    const Vector3 weight(0, 0, -particle.mass * gravity);
    particle.kick(last.force + weight, last.torque, 0.5 * step);
    particle.drift(step);
    last = find(particle, material, step);
    particle.kick(last.force + weight, last.torque, 0.5 * step);
  }
};

double tilt_of(const Particle& particle) {
  return std::acos(std::min(1.0, particle.body.pose.rotation.col(2).cwiseAbs().maxCoeff()));
}

}  // namespace

TEST_CASE("lammps: bodies have faces where they are flat along two axes") {
  CHECK(ParticleShape(kBrick, 2, 2).faces.empty());
  CHECK(ParticleShape(kBrick, 4, 4).faces.empty());
  CHECK(ParticleShape(kBrick, 8, 8).faces.size() == 3);
  const ParticleShape can(kBrick, 2, 20);
  REQUIRE(can.faces.size() == 1);
  CHECK(can.faces[0].axis == 2);
  CHECK(can.faces[0].count == 8);
  for (const double e : {6.0, 8.0, 20.0, 60.0, 1000.0}) {
    const ParticleShape shape(kBrick, e, e);
    REQUIRE(shape.faces.size() == 3);
    for (const Face& face : shape.faces) {
      CHECK(face.height == kBrick[face.axis]);
      CHECK(face.bulge > 0);
      CHECK(face.bulge < 3e-3 * kBrick.minCoeff());
      // Vertices stick out of the body, by no more than this.
      for (int k = 0; k < face.count; ++k) {
        const Vector2& vertex = face.vertices.at(static_cast<std::size_t>(k));
        double farthest = 0;
        for (int step = 0; step < 142; ++step) {
          const double tilt = 1e-6 * std::pow(1.1, step);  // up to 0.7 rad
          Vector3 normal;
          normal[face.axis] = std::cos(tilt);
          normal[(face.axis + 1) % 3] = std::sin(tilt) * vertex.normalized().x();
          normal[(face.axis + 2) % 3] = std::sin(tilt) * vertex.normalized().y();
          const double reach = std::cos(tilt) * face.height + std::sin(tilt) * vertex.norm();
          farthest = std::max(farthest, reach - shape.body.support(normal));
          if (tilt <= face.tilt) CHECK(reach >= shape.body.support(normal) - 1e-6 * face.height);
        }
        CHECK(farthest <= face.bulge * (1 + 1e-9));
      }
    }
  }
}

TEST_CASE("lammps: forces and torques of faces are the derivatives of the energy") {
  Random random{std::mt19937(3)};
  int meeting = 0, fading = 0;
  for (int i = 0; i < 400; ++i) {
    TwoBodies pair = facing(random, 0.1, {.stiffness = 1e5, .adhesion = i % 2 == 0 ? 0 : 3.0});
    const PairContact contact = pair.find(0);
    const auto faces = find_face_contact(pair.first.body, pair.second.body, contact.contact.normal);
    if (!faces) continue;
    ++meeting;
    fading += faces->share < 1 ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double scale = contact.force.normal + pair.material.adhesion;
      const TwoBodies::EnergySlopes slopes = pair.energy_slopes(axis, 1e-9, 1e-7);
      CHECK(std::abs(slopes.along - contact.force.force[axis]) < 2e-3 * scale);
      CHECK(std::abs(slopes.about + contact.torque2()[axis]) < 2e-3 * scale * 0.02);
    }
  }
  CHECK(meeting > 100);
  CHECK(fading > 20);
}

TEST_CASE("lammps: face contacts change neither momentum nor angular momentum") {
  Random random{std::mt19937(4)};
  for (int i = 0; i < 100; ++i) {
    TwoBodies pair = facing(random, 0.05, {.stiffness = 1e5, .restitution = 0.5, .friction = 0.4, .rolling_length = 1e-3});
    pair.first.set_velocity(random.vector(1), random.vector(20));
    for (int step = 0; step < 3; ++step) {
      const PairContact contact = pair.find(1e-5);
      const Vector3 change = contact.torque1() + contact.torque2() +
                             (pair.first.body.pose.position - pair.second.body.pose.position).cross(contact.force.force);
      CHECK(change.norm() <= 1e-14 * contact.force.force.norm());
    }
  }
}

TEST_CASE("lammps: exchanging two bodies exchanges their face forces") {
  Random random{std::mt19937(5)};
  for (int i = 0; i < 100; ++i) {
    TwoBodies pair = facing(random, 0.05, {.stiffness = 1e5});
    const PairContact there = pair.find(0);
    TwoBodies other{pair.second, pair.first, pair.material};
    const PairContact back = other.find(0);
    CHECK(back.force.energy == relative(there.force.energy).epsilon(1e-6));
    CHECK((back.force.force + there.force.force).norm() < 1e-5 * there.force.force.norm());
  }
}

TEST_CASE("lammps: a level brick has the whole stiffness, and one on an edge half of it") {
  Floor floor;
  Particle brick(kBrick, 60, 60);
  const ContactMaterial material = prepared({.stiffness = 1e5});
  brick.place({0, 0, kBrick.z() - 1e-5}, Eigen::Quaterniond::Identity());
  const WallForce level = floor.find(brick, material, 0);
  CHECK(level.force.z() == relative(1).epsilon(1e-9));
  CHECK(level.torque.norm() < 1e-12);
  CHECK(level.contacts == 1);
  // Tilted by more than its depth allows, on one edge of the face.
  const double tilt = 2e-3, reach = brick.shape->faces[2].vertices[0].x();
  brick.place({0, 0, std::cos(tilt) * kBrick.z() + std::sin(tilt) * reach - 1e-5},
              Eigen::Quaterniond(Eigen::AngleAxisd(tilt, Vector3::UnitY())));
  const WallForce edge = floor.find(brick, material, 0);
  CHECK(edge.force.z() == relative(0.5).epsilon(1e-6));
  CHECK(std::abs(edge.torque.y()) == relative(0.5 * (std::cos(tilt) * reach - std::sin(tilt) * kBrick.z())).epsilon(1e-3));
}

namespace {

/// Compares the force of a floor on a body that sinks into it by 1e-4 m with the slopes of the energy.
void check_slopes(Particle& body, const Eigen::Quaterniond& attitude, const ContactMaterial& material) {
  const double scale = material.stiffness * 1e-4;  // N
  Floor floor;
  double height = 0.05;
  const auto place = [&](double up, const Eigen::Quaterniond& turn) { body.place({0, 0, height + up}, turn * attitude); };
  const auto still = Eigen::Quaterniond::Identity();
  place(0, still);
  while (floor.find(body, material, 0).energy == 0) {
    height -= 5e-5;
    place(0, still);
  }
  height -= 1e-4;
  place(0, still);
  const WallForce force = floor.find(body, material, 0);
  const auto energy = [&](double up, const Eigen::Quaterniond& turn) {
    place(up, turn);
    return floor.find(body, material, 0).energy;
  };
  CHECK((energy(-1e-9, still) - energy(1e-9, still)) / 2e-9 - force.force.z() == doctest::Approx(0).scale(scale).epsilon(1e-3));
  for (int axis = 0; axis < 3; ++axis) {
    const auto turn = [&](double angle) { return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3::Unit(axis))); };
    const double slope = (energy(0, turn(1e-7)) - energy(0, turn(-1e-7))) / 2e-7;
    CHECK(std::abs(slope + force.torque[axis]) < 1e-3 * scale * 0.02);
  }
}

ContactMaterial sticky(int i) { return prepared({.stiffness = 1e5, .adhesion = i % 2 == 0 ? 0 : 3.0}); }

}  // namespace

TEST_CASE("lammps: forces of a face on a plane are the derivatives of the energy") {
  Random random{std::mt19937(6)};
  for (int i = 0; i < 100; ++i) {
    Particle brick(kBrick, random(6, 30), random(6, 30));
    check_slopes(brick, tilted(random(0, 0.15), random) * face_up(static_cast<int>(random(0, 2.999))), sticky(i));
  }
}

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
    Particle body(kBrick, is_can ? random(1.5, 3.5) : random(8, 30), is_can ? random(8, 30) : random(1.5, 3.5));
    const Eigen::Quaterniond lies(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitY()));
    const Eigen::Quaterniond rolled(Eigen::AngleAxisd(random(-3, 3), Vector3::Unit(is_can ? 2 : 1)));
    check_slopes(body, tilted(random(0, 0.3), random) * lies * rolled, sticky(i));
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
      const Eigen::Quaterniond lies(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3::UnitY()));
      can.place({0, 0, 0.012}, Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Vector3(0.2, 1, 0.2).normalized())) * lies);
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

TEST_CASE("lammps: a brick that lands flat rebounds with the restitution") {
  for (const double restitution : {0.2, 0.7}) {
    Floor floor;
    Particle brick(kBrick, 20, 20);
    const ContactMaterial material = prepared({.stiffness = 1e5, .restitution = restitution});
    brick.place({0, 0, kBrick.z() + 1e-6}, Eigen::Quaterniond::Identity());
    brick.set_velocity({0, 0, -0.1}, Vector3::Zero());
    WallForce last;
    for (int i = 0; i < 20000; ++i) floor.advance(brick, material, 1e-6, 0, last);
    CHECK(brick.body.velocity.z() == relative(0.1 * restitution).epsilon(1e-3));
  }
}

TEST_CASE("lammps: adhesion pulls a level brick in its middle, without a torque, and raises the limit of friction") {
  Floor floor;
  Particle brick(kBrick, 20, 20);
  const ContactMaterial material = prepared({.stiffness = 1e5, .friction = 0.5, .adhesion = 3});
  brick.place({0, 0, kBrick.z() - 1e-5}, Eigen::Quaterniond::Identity());
  const WallForce still = floor.find(brick, material, 0);
  CHECK(still.force.z() == relative(1 - 3).epsilon(1e-9));
  CHECK(still.torque.norm() < 1e-12);
  brick.set_velocity({1, 0, 0}, Vector3::Zero());
  const WallForce slides = floor.find(brick, material, 1e-4);
  CHECK(slides.force.x() == relative(-0.5 * 1).epsilon(1e-9));
}

TEST_CASE("lammps: tumbling bricks keep their energy through an impact") {
  Random random{std::mt19937(7)};
  for (int i = 0; i < 10; ++i) {
    TwoBodies pair = facing(random, 0.03, {.stiffness = 1e5});
    pair.first.set_velocity(Vector3::Zero(), random.vector(1));
    PairContact last = pair.find(0);
    const auto energy = [&] { return pair.first.kinetic_energy() + pair.second.kinetic_energy() + last.force.energy; };
    const double start = energy();
    for (int step = 0; step < 20000; ++step) pair.advance(5e-7, last);
    CHECK(energy() == relative(start).epsilon(1e-4));
  }
}

TEST_CASE("lammps: a dropped brick comes to rest on its face") {
  for (const double e : {8.0, 12.0, 20.0, 60.0}) {
    Floor floor;
    Particle brick(kBrick, e, e);
    const ContactMaterial material = prepared({.stiffness = 2e4, .restitution = 0.3, .friction = 0.5});
    brick.place({0, 0, 1.2 * kBrick.z()}, Eigen::Quaterniond(Eigen::AngleAxisd(0.03, Vector3(1, 0.7, 0.2).normalized())));
    WallForce last;
    for (int i = 0; i < 50000; ++i) floor.advance(brick, material, 1e-5, 9.81, last);
    CAPTURE(e);
    CHECK(brick.body.velocity.norm() < 1e-9);
    CHECK(brick.body.angular_velocity.norm() < 1e-7);
    CHECK(tilt_of(brick) < 1e-6);
    CHECK(last.force.z() == relative(brick.mass * 9.81).epsilon(1e-6));
  }
}

TEST_CASE("lammps: friction holds a brick on a slope and stops its spin, up to Coulomb's limit") {
  const ContactMaterial material = prepared({.stiffness = 2e4, .restitution = 0.3, .friction = 0.5});
  Floor floor;
  Particle brick(kBrick, 20, 20);
  const double weight = brick.mass * 9.81;
  brick.place({0, 0, kBrick.z() - weight / material.stiffness}, Eigen::Quaterniond::Identity());
  brick.set_velocity(Vector3::Zero(), {0, 0, 2});
  WallForce last = floor.find(brick, material, 0);
  floor.advance(brick, material, 1e-5, 9.81, last);
  // While it slides, the torque is the limit times the lever arm of the corners.
  const double arm = brick.shape->faces[2].vertices[0].norm();
  for (int i = 0; i < 100; ++i) floor.advance(brick, material, 1e-5, 9.81, last);
  CHECK(-last.torque.z() == relative(0.5 * weight * arm).epsilon(1e-3));
  for (int i = 0; i < 20000; ++i) floor.advance(brick, material, 1e-5, 9.81, last);
  CHECK(std::abs(brick.body.angular_velocity.z()) < 1e-6);
}
