// Tests of the properties of the contact law.
#include "kernel/contact_law.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

#include "kernel/body.hpp"
#include "kernel/contact_material.hpp"
#include "support/refusal.hpp"
#include "support/relative.hpp"
#include "two_bodies.hpp"

using namespace granular;
using namespace granular::test;
using supernormal::test::relative;

namespace {

std::string refusal(const ContactMaterial& material) {
  return supernormal::test::refusal([&] { prepared(material); });
}

/// Two superellipsoids that overlap by a few per cent of their size.
TwoBodies overlapping(std::mt19937& random, const ContactMaterial& material) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&] { return Vector3(unit(random), unit(random), unit(random)); };
  const auto attitude = [&] { return Eigen::Quaterniond(unit(random), unit(random), unit(random), unit(random)).normalized(); };
  TwoBodies pair{{{0.02, 0.015, 0.01}, 3, 1.7}, {{0.012, 0.015, 0.018}, 2.4, 4}, prepared(material)};
  pair.first.place({0.1, 0.2, 0.3}, attitude());
  const Vector3 direction = vector().normalized();
  double distance = 0.05;
  pair.second.place(pair.first.body.pose.position + distance * direction, attitude());
  while (pair.find(0).state != PairState::Touching) {
    distance -= 2e-4;
    pair.second.place(pair.first.body.pose.position + distance * direction, pair.second.attitude);
  }
  pair.first.set_velocity(vector(), 20 * vector());
  pair.second.set_velocity(vector(), 20 * vector());
  return pair;
}

}  // namespace

TEST_CASE("lammps: an invalid material is refused with name, value and range") {
  CHECK(refusal({.stiffness = 0}) == "stiffness = 0 is outside (0, inf)");
  CHECK(refusal({.law = NormalLaw::Hertz, .stiffness = -1}) == "modulus = -1 is outside (0, inf)");
  CHECK(refusal({.stiffness = 1, .restitution = 0.01}) == "restitution = 0.01 is outside [0.05, 1]");
  CHECK(refusal({.stiffness = 1, .friction = std::nan("")}) == "friction = nan is outside [0, inf)");
  CHECK(refusal({.stiffness = 1, .tangential_ratio = 2}) == "tangential = 2 is outside (0, 1]");
  CHECK(refusal({.stiffness = 1, .rolling_length = -1}) == "rolling = -1 is outside [0, inf)");
  CHECK(refusal({.stiffness = 1, .spinning_length = -1}) == "spinning = -1 is outside [0, inf)");
  CHECK(refusal({.stiffness = 1, .adhesion = -1}) == "adhesion = -1 is outside [0, inf)");
  CHECK(refusal({.stiffness = 1}).empty());
}

TEST_CASE("lammps: two materials have springs in series, and Mindlin's stiffness of two materials") {
  const double E1 = 1e8, nu1 = 0.3, E2 = 4e7, nu2 = 0.45;
  const auto of = [](double E, double nu, double friction) {
    return prepared({.law = NormalLaw::Hertz,
                     .stiffness = effective_modulus(E, nu),
                     .restitution = 0.5,
                     .friction = friction,
                     .tangential_ratio = mindlin_ratio(nu)});
  };
  const ContactMaterial both = mixed(of(E1, nu1, 0.1), of(E2, nu2, 0.4));
  // Johnson, Contact Mechanics: E* of eq. 4.22, and the tangential over the normal stiffness, 8 a G* / (2 a E*), of section 7.2.
  const double modulus = 1 / ((1 - nu1 * nu1) / E1 + (1 - nu2 * nu2) / E2);
  const double G1 = E1 / 2 / (1 + nu1), G2 = E2 / 2 / (1 + nu2);
  const double shear = 1 / ((2 - nu1) / G1 + (2 - nu2) / G2);
  CHECK(both.stiffness == relative(modulus).epsilon(1e-12));
  CHECK(both.tangential_ratio == relative(4 * shear / modulus).epsilon(1e-12));
  CHECK(both.friction == relative(0.2).epsilon(1e-12));
  CHECK(both.damping_ratio == of(E1, nu1, 0).damping_ratio);
  CHECK_THROWS_WITH_AS(mixed(of(E1, nu1, 0), prepared({.stiffness = 1})), "hooke and hertz do not mix", std::invalid_argument);
}

TEST_CASE("lammps: damping and restitution are inverse functions on both sides of critical damping") {
  CHECK(hooke_damping_ratio(1) == 0);
  CHECK(hooke_damping_ratio(std::exp(-2.0)) == relative(1).epsilon(1e-6));
  // At b = 1/sqrt(2) the force vanishes after pi/2 of the damped oscillation.
  CHECK(hooke_damping_ratio(std::exp(-std::acos(-1.0) / 2)) == relative(std::sqrt(0.5)).epsilon(1e-9));
  CHECK(hooke_damping_ratio(0.05) > 1);
}

TEST_CASE("lammps: Hertz's force becomes the force of a flat punch without a jump, and is the derivative of its energy") {
  const ContactMaterial material{.law = NormalLaw::Hertz, .stiffness = 1e7};
  const supernormal::ContactCurvature curvature{0.3, 200};
  double last = 0;
  for (int i = 0; i < 114; ++i) {  // up to 0.05
    const double depth = 1e-6 * std::pow(1.1, i);
    const double h = 1e-5 * depth;
    const NormalForce here = hertz_force(material, depth, curvature, 0.01);
    const double slope =
        (hertz_force(material, depth + h, curvature, 0.01).energy - hertz_force(material, depth - h, curvature, 0.01).energy) /
        (2 * h);
    CHECK(here.force == relative(slope).epsilon(1e-4));
    CHECK(here.force > last);
    last = here.force;
  }
  // In a deep overlap it is the punch's force, and for a flat contact it is nothing else.
  CHECK(last == relative(hertz_force(material, 0.05 / 1.1, {}, 0.01).force).epsilon(0.1));
  CHECK(hertz_force(material, 1e-3, {}, 0.01).force == relative(2e2).epsilon(1e-12));
}

TEST_CASE("lammps: elastic forces and torques are the derivatives of the energy") {
  std::mt19937 random(7);
  for (int i = 0; i < 50; ++i) {
    TwoBodies pair = overlapping(random, {.stiffness = 1e5, .adhesion = i % 2 == 0 ? 0 : 2.0});
    const PairContact contact = pair.find(0);
    for (int axis = 0; axis < 3; ++axis) {
      // `contact` belongs to body 1.
      const TwoBodies::EnergySlopes slopes = pair.energy_slopes(axis, 1e-8, 1e-6);
      CHECK(slopes.along.miss(contact.force.force[axis]) < 1e-3 * contact.force.normal);
      CHECK(slopes.about.miss(-contact.torque2()[axis]) < 1e-3 * contact.force.normal * 0.02);
    }
  }
}

TEST_CASE("lammps: a contact changes neither momentum nor angular momentum") {
  std::mt19937 random(8);
  const ContactMaterial material{
      .stiffness = 1e5, .restitution = 0.5, .friction = 0.4, .rolling_length = 1e-3, .spinning_length = 2e-3, .adhesion = 2};
  for (int i = 0; i < 50; ++i) {
    TwoBodies pair = overlapping(random, material);
    for (int step = 0; step < 3; ++step) {
      const PairContact contact = pair.find(1e-5);
      const Vector3 change = contact.torque1() + contact.torque2() +
                             (pair.first.body.pose.position - pair.second.body.pose.position).cross(contact.force.force);
      CHECK(change.norm() <= 1e-14 * contact.force.force.norm());
    }
  }
}

TEST_CASE("lammps: friction stays in Coulomb's cone and rotates with the pair") {
  std::mt19937 random(9);
  const ContactMaterial material{
      .stiffness = 1e5, .restitution = 0.7, .friction = 0.4, .rolling_length = 1e-3, .spinning_length = 2e-3};
  for (int i = 0; i < 50; ++i) {
    TwoBodies pair = overlapping(random, material);
    const PairContact before = [&] {
      PairContact last;
      for (int step = 0; step < 5; ++step) last = pair.find(1e-6);
      return last;
    }();
    const double friction = (before.force.force - before.force.force.dot(before.contact.normal) * before.contact.normal).norm();
    CHECK(friction <= 0.4 * before.force.normal * (1 + 1e-12));
    const double spinning = before.force.torque.dot(before.contact.normal);
    CHECK((before.force.torque - spinning * before.contact.normal).norm() <= 1e-3 * before.force.normal * (1 + 1e-12));
    CHECK(std::abs(spinning) <= 2e-3 * before.force.normal * (1 + 1e-12));
    // Both bodies rotate by half a revolution as one, and the springs rotate with them.
    const Vector3 spin = 30 * Vector3(1, -2, 0.5).normalized();
    pair.first.set_velocity(Vector3::Zero(), Vector3::Zero());
    pair.second.set_velocity(Vector3::Zero(), Vector3::Zero());
    const PairContact still = pair.find(0);
    const int steps = 2000;
    const double step = std::acos(-1.0) / spin.norm() / steps;
    const Vector3 origin = pair.first.body.pose.position;
    PairContact turned;
    Eigen::Quaterniond rotation;
    const Particle first = pair.first, second = pair.second;
    for (int k = 1; k <= steps; ++k) {
      rotation = Eigen::AngleAxisd(k * step * spin.norm(), spin.normalized());
      pair.first.place(origin, rotation * first.attitude);
      pair.second.place(origin + rotation * (second.body.pose.position - origin), rotation * second.attitude);
      pair.first.set_velocity(Vector3::Zero(), spin);
      pair.second.set_velocity(spin.cross(pair.second.body.pose.position - origin), spin);
      turned = pair.find(step);
    }
    CHECK((turned.force.force - rotation * still.force.force).norm() < 2e-3 * still.force.force.norm());
    CHECK((turned.force.torque - rotation * still.force.torque).norm() <= 2e-3 * still.force.torque.norm());
  }
}

TEST_CASE("lammps: the springs of friction and rolling gain no energy while a contact is loaded and unloaded") {
  ContactMaterial material{.law = NormalLaw::Hertz, .stiffness = 1e7, .friction = 100};
  TwoBodies pair = balls(0.01, 0, material);
  const auto set_depth = [&](double depth) { pair.second.place({0.01 - depth, 0, 0}, Eigen::Quaterniond::Identity()); };
  set_depth(1e-4);
  pair.second.set_velocity({0, 0.01, 0}, Vector3::Zero());
  for (int i = 0; i < 100; ++i) pair.find(1e-5);
  pair.second.set_velocity(Vector3::Zero(), Vector3::Zero());
  const auto spring_energy = [&] { return 0.5 * pair.history.stiffness * pair.history.sliding.squaredNorm(); };
  double last = spring_energy();
  REQUIRE(last > 0);
  for (const double depth : {1.5e-4, 2e-4, 1.2e-4, 5e-5, 1e-4, 1.5e-4}) {
    set_depth(depth);
    pair.find(1e-5);
    CHECK(spring_energy() <= last * (1 + 1e-12));
    last = spring_energy();
  }
}

TEST_CASE("lammps: a particle of a cluster has the mobility of the cluster, in any orientation") {
  // A damper of a particle of a cluster is the same as of a free body with this mass and inertia whose arm is longer.
  const Cluster cluster{7, 2.0, {0.01, -0.02, 0.005}, Vector3(3e3, 5e3, 4e3).asDiagonal()};
  double values[Cluster::kSize];
  cluster.store(values);
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(0.3, -0.4, 0.5, 0.7).normalized();
  Body part, whole, floor;
  part.pose.rotation = whole.pose.rotation = rotation.toRotationMatrix();
  Cluster::load(values).apply(part);
  cluster.apply(whole);
  whole.from_centre.setZero();
  part.velocity = whole.velocity = {0.1, 0.2, -0.5};
  const ContactMaterial material = prepared({.stiffness = 1e4, .restitution = 0.4, .friction = 0.5});
  const Vector3 normal = Vector3(1, 2, -1).normalized(), arm(0, 0.01, 0.003);
  ContactHistory history;
  const auto force_of = [&](const Body& body, const Vector3& at) {
    return contact_force({normal, at, Vector3::Zero(), 1e-4}, hooke_force(material, 1e-4), material, body, floor, 0, history);
  };
  const ContactForce found = force_of(part, arm), expected = force_of(whole, arm + rotation * cluster.from_centre);
  CHECK((found.force - expected.force).norm() < 1e-12 * expected.force.norm());
  CHECK((found.force - force_of(whole, arm).force).norm() > 0.01 * expected.force.norm());
  CHECK(cluster.is_same(Cluster::load(values)));
  CHECK_FALSE(Cluster().is_same(Cluster()));
}

TEST_CASE("lammps: a history is stored and read without loss of digits") {
  const ContactHistory history{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 10};
  double values[ContactHistory::kSize];
  history.store(values);
  for (int i = 0; i < ContactHistory::kSize; ++i) CHECK(values[i] == i + 1);
  const ContactHistory read = ContactHistory::load(values);
  CHECK(read.sliding == history.sliding);
  CHECK(read.stiffness == history.stiffness);
}
