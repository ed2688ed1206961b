// A rattleback against the published run of Kane and Levinson (samples/studies/single_bodies/rattleback.hpp).
#include "rattleback.hpp"

#include <doctest/doctest.h>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;
using single_bodies::Rattleback;

namespace {

struct NoSlipFloor : World {
  NoSlipFloor() {
    add_plane();
    surface.mu = dInfinity;
  }
};

double vertical_spin(const Rattleback& rattleback) { return dBodyGetAngularVel(rattleback.body())[2]; }  // rad/s

constexpr double kEnergy = 0.12388531;  // J

}  // namespace

TEST_CASE("a rattleback spun against its preferred sense reverses at the published time") {
  // tests/data/README.md: "no slip, omega_3 = -5 rad/s: the spin first reverses at 2.3527 s; smallest yaw -6.81015 rad at 2.8150 s;
  // energy 0.12388531 J conserved." omega_3 is in the body's frame and swings with the rattling. The vertical spin reverses
  // at 2.6847 s (the same equations of motion, integrated by the Runge-Kutta method).
  //
  // A step projects the last velocity on the constraint at the new contact point, which moves along the keel at metres a second.
  // The loss of energy is proportional to the step (0.94, 1.86, 4.6 thousandths at 2, 4, 10 us).
  OdeSession session;
  NoSlipFloor world;
  Rattleback rattleback(world.id(), world.space(), -5);
  CHECK(energy(rattleback.body()) == relative(kEnergy).epsilon(1e-7));
  const double dt = 4e-6;
  double reversal = 0;
  double vertical_reversal = 0;
  double smallest_yaw = 0;
  double most = 0;
  for (int step = 1; step * dt < 2.9; ++step) {
    world.quick_step(dt);
    rattleback.follow();
    if (reversal == 0 && rattleback.spin() > 0) reversal = step * dt;
    if (vertical_reversal == 0 && vertical_spin(rattleback) > 0) vertical_reversal = step * dt;
    smallest_yaw = std::min(smallest_yaw, rattleback.yaw());
    most = std::max(most, energy(rattleback.body()));
  }
  CHECK(reversal == relative(2.3527).epsilon(5e-3));
  CHECK(vertical_reversal == relative(2.6847).epsilon(1e-3));
  CHECK(smallest_yaw == relative(-6.81015).epsilon(0.01));
  CHECK(energy(rattleback.body()) > kEnergy * (1 - 2.5e-3));
  CHECK(most < kEnergy * (1 + 1e-6));
}

TEST_CASE("a rattleback spun in its preferred sense does not reverse early") {
  // tests/data/README.md: "Released at +5 it does not reverse early: yaw 24.767 rad at 5 s."
  OdeSession session;
  NoSlipFloor world;
  Rattleback rattleback(world.id(), world.space(), 5);
  const double dt = 2e-5;
  double slowest = 5;
  for (int step = 1; step <= 250000; ++step) {
    world.quick_step(dt);
    rattleback.follow();
    slowest = std::min(slowest, vertical_spin(rattleback));
  }
  CHECK(slowest > 3);
  CHECK(rattleback.yaw() == relative(24.767).epsilon(1e-3));
  CHECK(energy(rattleback.body()) == relative(kEnergy).epsilon(2e-3));
}
