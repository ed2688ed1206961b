// Impacts of two bodies against their closed forms, without an allocation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/counted_allocations.hpp"
#include "support/relative.hpp"
#include "two_bodies.hpp"

using namespace granular;
using namespace granular::test;
using supernormal::test::relative;

namespace {

constexpr double kRadius = 0.01;  // m
constexpr double kSpeed = 0.5;    // m/s

// So stiff that the normal rotates little in an impact.
constexpr double kStiffness = 1e7;  // N/m

ContactMaterial hooke(double restitution) { return {.stiffness = kStiffness, .restitution = restitution}; }

/// Equal balls: the mass of the relative motion is half of one mass.
double reduced_mass(const TwoBodies& pair) { return 0.5 * pair.first.mass; }

}  // namespace

TEST_CASE("lammps: an elastic impact on a linear spring lasts pi sqrt(m/k)") {
  TwoBodies pair = balls(kRadius, kSpeed, hooke(1));
  const double period = std::numbers::pi * std::sqrt(reduced_mass(pair) / kStiffness);
  const Impact impact = collide(pair, period / 2000);
  CHECK(impact.time == relative(period).epsilon(1e-3));
  CHECK(impact.overlap == relative(kSpeed * period / std::numbers::pi).epsilon(1e-5));
  CHECK(pair.second.body.velocity.x() == relative(0.5 * kSpeed).epsilon(1e-6));
}

TEST_CASE("lammps: elastic Hertz impacts have the overlap and time of the closed form") {
  ContactMaterial material{.law = NormalLaw::Hertz, .stiffness = effective_modulus(1e8, 0.3)};
  TwoBodies pair = balls(kRadius, kSpeed, material);
  // Two equal balls: the relative radius is half of one radius (Johnson, Contact Mechanics, section 11.4).
  const double k = 4.0 / 3 * material.stiffness * std::sqrt(0.5 * kRadius);
  const double overlap = std::pow(1.25 * reduced_mass(pair) * kSpeed * kSpeed / k, 0.4);
  const double time = 2.9432675 * overlap / kSpeed;
  const Impact impact = collide(pair, time / 2000);
  CHECK(impact.overlap == relative(overlap).epsilon(1e-5));
  CHECK(impact.time == relative(time).epsilon(1e-3));
  CHECK(pair.second.body.velocity.x() == relative(0.5 * kSpeed).epsilon(1e-6));
}

TEST_CASE("lammps: impacts have the given restitution at every velocity") {
  for (const NormalLaw law : {NormalLaw::Hooke, NormalLaw::Hertz}) {
    for (const double restitution : {0.05, 0.1, 0.3, 0.7, 0.95}) {
      for (const double speed : {0.01, 1.0}) {
        CAPTURE(restitution);
        TwoBodies pair = balls(kRadius, speed,
                               {.law = law, .stiffness = law == NormalLaw::Hooke ? kStiffness : 1e9, .restitution = restitution});
        collide(pair, 2e-9 / std::pow(speed, 0.2));
        CHECK(std::abs(2 * pair.second.body.velocity.x() / speed - restitution) < 1e-3);
      }
    }
  }
}

TEST_CASE("lammps: an impact off the line of centres has the restitution for the effective mass there") {
  ContactMaterial material = hooke(0.6);
  TwoBodies pair{{{0.02, 0.005, 0.005}, 2, 2}, {{0.02, 0.005, 0.005}, 2, 2}, prepared(material)};
  pair.second.place({0.025, 0.01, 0}, Eigen::Quaterniond::Identity());
  pair.first.set_velocity({0, 0.1, 0}, Vector3::Zero());
  const auto approach = [&](const PairContact& contact) {
    return (pair.first.body.velocity_at(contact.contact.arm1) - pair.second.body.velocity_at(contact.contact.arm2))
        .dot(contact.contact.normal);
  };
  PairContact last;
  double in = 0, out = 0;
  for (int i = 0; i < 4000000; ++i) {
    pair.advance(1e-8, last);
    if (last.state == PairState::Touching) {
      if (in == 0) in = approach(last);
      out = approach(last);
    } else if (in != 0) {
      break;
    }
  }
  REQUIRE(in > 0);
  CHECK(-out / in == relative(0.6).epsilon(0.01));
}

TEST_CASE("lammps: in an oblique impact that sticks, the tangential spring makes the part of an oscillation of the closed form") {
  // If the normal does not rotate, the tangential motion is the motion of a spring on the mass 1/(1/m + R^2/I) = 2/7 m. Its
  // velocity has changed by cos(omega_t t) when the contact ends (Schaefer, Dippel and Wolf, J. Phys. I 6, 5 (1996)).
  for (const double ratio : {0.1, 2 / 7.0, 0.8}) {
    ContactMaterial material = hooke(1);
    material.friction = 1e6;
    material.tangential_ratio = ratio;
    TwoBodies pair = balls(kRadius, kSpeed, material);
    const double slip = 0.02, spin = 0.7;  // m/s, rad/s
    pair.first.set_velocity({0.5 * kSpeed, 0.5 * slip, 0}, {0, 0, spin});
    pair.second.set_velocity({-0.5 * kSpeed, -0.5 * slip, 0}, {0, 0, spin});
    const double rate = slip + 2 * spin * kRadius;
    const double time = std::numbers::pi * std::sqrt(reduced_mass(pair) / kStiffness);
    collide(pair, time / 4000);
    const double out = pair.first.body.velocity.y() - pair.second.body.velocity.y() +
                       kRadius * (pair.first.body.angular_velocity.z() + pair.second.body.angular_velocity.z());
    CHECK(std::abs(out / rate - std::cos(std::sqrt(3.5 * ratio) * std::numbers::pi)) < 5e-3);
  }
}

TEST_CASE("lammps: in an oblique impact that slides, friction takes mu times the normal impulse") {
  for (const double restitution : {1.0, 0.6}) {
    ContactMaterial material = hooke(restitution);
    material.friction = 0.2;
    TwoBodies pair = balls(kRadius, kSpeed, material);
    const double slip = 2;  // m/s
    pair.first.set_velocity({0.5 * kSpeed, 0.5 * slip, 0}, Vector3::Zero());
    pair.second.set_velocity({-0.5 * kSpeed, -0.5 * slip, 0}, Vector3::Zero());
    collide(pair, 1e-8);
    const double impulse = 0.2 * (1 + restitution) * 0.5 * kSpeed;  // over the mass of a ball
    CHECK(pair.first.body.velocity.y() == relative(0.5 * slip - impulse).epsilon(5e-3));
    CHECK(pair.first.body.angular_velocity.z() == relative(-2.5 * impulse / kRadius).epsilon(0.02));
  }
}

// The executable replaces operator new for everything in it.
TEST_CASE("lammps: a pair in contact or apart is solved without allocation") {
  for (const NormalLaw law : {NormalLaw::Hooke, NormalLaw::Hertz}) {
    const ContactMaterial material{.law = law, .stiffness = 1e5, .restitution = 0.5, .friction = 0.3, .rolling_length = 1e-4};
    TwoBodies pair{{{0.02, 0.015, 0.01}, 3, 1.5}, {{0.01, 0.01, 0.02}, 8, 8}, prepared(material)};
    pair.settings.stop_when_apart = true;
    // The first deep overlap allocates the scratch memory of the thread.
    pair.second.place({0.02, 0, 0}, Eigen::Quaterniond::Identity());
    pair.find(1e-5);
    int touching = 0;
    const long before = supernormal::test::allocations();
    for (int i = 0; i < 400; ++i) {
      pair.second.place({0.036 - 2e-5 * i, 0.008, 0.004}, {1, 0.2, 0.1 + 1e-3 * i, 0.3});
      touching += pair.find(1e-5).state == PairState::Touching ? 1 : 0;
    }
    CHECK(supernormal::test::allocations() == before);
    CHECK(touching > 50);
    CHECK(touching < 350);
  }
}
