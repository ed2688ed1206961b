// Faces that meet: their geometry, the gradient of their energy, and bodies that rest on them.
#include "kernel/face_contact.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "flat_bodies.hpp"
#include "support/relative.hpp"

using namespace granular;
using namespace granular::test;
using supernormal::test::relative;

namespace {

/// Two boxy bodies whose faces overlap in part, tilted by up to `tilt` (rad), in any orientation.
TwoBodies facing(Random& random, double tilt, const ContactMaterial& material) {
  TwoBodies pair{{kBrick, random(6, 30), random(6, 30)}, {{0.012, 0.018, 0.012}, random(6, 60), random(6, 60)}, prepared(material)};
  const int axis1 = static_cast<int>(random(0, 2.999)), axis2 = static_cast<int>(random(0, 2.999));
  const Eigen::Quaterniond world = random.attitude();
  pair.second.attitude = tilted(random(0, tilt), random) * face_up(axis2);
  const Vector3 aside{random(-0.01, 0.01), random(-0.01, 0.01), 0};
  pair.first.attitude = tilted(0, random) * face_up(axis1);
  lower(pair, world, aside, random);
  return pair;
}

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

TEST_CASE("lammps: forces and torques of faces are the derivatives of the energy") { check_pair_slopes(facing, 3, 0.1, 0); }

TEST_CASE("lammps: face contacts change neither momentum nor angular momentum") {
  constexpr double kStiffness = 1e5;  // N/m
  Random random{std::mt19937(4)};
  for (int i = 0; i < 100; ++i) {
    TwoBodies pair = facing(random, 0.05, {.stiffness = kStiffness, .restitution = 0.5, .friction = 0.4, .rolling_length = 1e-3});
    pair.first.set_velocity(random.vector(1), random.vector(20));
    for (int step = 0; step < 3; ++step) {
      const PairContact contact = pair.find(1e-5);
      const Vector3 change = contact.torque1() + contact.torque2() +
                             (pair.first.body.pose.position - pair.second.body.pose.position).cross(contact.force.force);
      CHECK(change.norm() <= 1e-15 * kStiffness * 2e-4);  // damping may leave little of the elastic force
    }
  }
}

TEST_CASE("lammps: exchanging two bodies exchanges their face forces") { check_exchange(facing, 5, 1e-6); }

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

TEST_CASE("lammps: forces of a face on a plane are the derivatives of the energy") {
  Random random{std::mt19937(6)};
  for (int i = 0; i < 100; ++i) {
    Particle brick{kBrick, random(6, 30), random(6, 30)};
    const Eigen::Quaterniond up = face_up(static_cast<int>(random(0, 2.999)));
    check_slopes(brick, tilted(random(0, 0.15), random) * up, sticky(i));
  }
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

TEST_CASE("lammps: tumbling bricks keep their energy through an impact") { check_energy(facing, 7); }

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
