// Tests that round bodies neither stop by themselves nor gain energy. A body that rocks on a plane keeps its period and its
// amplitude while its contact point moves.
#include <doctest/doctest.h>

#include "support/ode_world.hpp"
#include "support/relative.hpp"

using namespace supernormal::test;

namespace {

/// A body of half-axes (0.3, 0.2, 0.1) m with delta = epsilon = exponent, released at a tilt (rad) about y.
struct Rocking {
  double exponent;
  double tilt;
  bool rolls;  ///< without slip; otherwise without friction

  static constexpr double kA = 0.3, kB = 0.2, kC = 0.1;  // m

  /// The height of the centre over the plane at a tilt, and its derivative. It is the support function of the section, the dual
  /// norm.
  std::array<double, 2> height(double theta) const {
    const double q = exponent / (exponent - 1);
    const double s = kA * std::abs(std::sin(theta));
    const double c = kC * std::cos(theta);
    const double h = std::pow(std::pow(s, q) + std::pow(c, q), 1 / q);
    const double slope = kA * std::cos(theta) * std::pow(s / h, q - 1) - kC * std::abs(std::sin(theta)) * std::pow(c / h, q - 1);
    return {h, std::copysign(slope, theta)};
  }

  /// The moment of inertia about y for mass 1: <x^2> + <z^2> of tests/data/README.md.
  double inertia() const {
    const auto gamma = [](double x) { return std::tgamma(x); };
    const double e = exponent;
    const double xx = gamma(3 / e) * gamma(1 + 2 / e) / (gamma(1 / e) * gamma(1 + 4 / e)) * gamma(1 + 4 / e) * gamma(1 + 3 / e) /
                      (gamma(1 + 5 / e) * gamma(1 + 2 / e));
    const double zz = gamma(3 / e) * gamma(1 + 3 / e) / (gamma(1 / e) * gamma(1 + 5 / e));
    return kA * kA * xx + kC * kC * zz;
  }

  /// The period by conservation of energy: g h(theta) + m(theta) theta'^2 / 2 = g h(tilt). The centre moves up and down with h',
  /// and along with h if the body rolls. theta = tilt sin(u) removes the singularities at the ends; u = v^2 removes the cusp of h''
  /// in the middle.
  double period() const {
    const int intervals = 2000;
    const double length = std::sqrt(std::numbers::pi / 2);
    const double top = height(tilt)[0];
    double sum = 0;
    for (int i = 0; i < intervals; ++i) {
      const double v = (i + 0.5) / intervals * length;
      const double theta = tilt * std::sin(v * v);
      const auto [h, slope] = height(theta);
      const double mass = inertia() + slope * slope + (rolls ? h * h : 0);
      sum += std::sqrt(mass / (2 * kGravity * (top - h))) * tilt * std::cos(v * v) * 2 * v;
    }
    return 4 * sum * length / intervals;
  }
};

struct Motion {
  double period;     ///< s, mean of ten
  double amplitude;  ///< rad, of the last swing
};

Motion rock(const Rocking& rocking, double dt) {
  OdeSession session;
  World world;
  world.add_plane();
  // The constraint acts on velocities at the beginning of a step, so the centre falls short of the rising h by h'' theta'^2 dt^2 /
  // 2 in each step. Without ERP this adds up (tilt 0.3, dt 1e-4: 1.4 mm and 3 % of the amplitude over ten periods).
  dWorldSetERP(world.id(), dReal(0.8));
  world.surface.mu = rocking.rolls ? dInfinity : 0;
  const dGeomID geom = snCreateSuperellipsoid(world.space(), dReal(Rocking::kA), dReal(Rocking::kB), dReal(Rocking::kC),
                                              dReal(rocking.exponent), dReal(rocking.exponent));
  const dBodyID body = world.add(geom, 1000);
  turn(body, {0, 1, 0}, rocking.tilt);
  dBodySetPosition(body, 0, 0, dReal(rocking.height(rocking.tilt)[0] - 1e-9));  // touching

  const int periods = 10;
  const int swings = 2 * periods;
  int passages = 0;
  double first = 0;
  double extreme = 0;
  Motion motion{};
  double before = rocking.tilt;
  const double patience = 2 * swings * rocking.period();
  for (int step = 1; passages <= swings; ++step) {
    world.quick_step(dt);
    const dReal* const q = dBodyGetQuaternion(body);
    const double theta = 2 * std::atan2(q[2], q[0]);
    extreme = std::max(extreme, std::abs(theta));
    if (theta * before < 0) {
      const double time = dt * (step - theta / (theta - before));
      if (passages == 0) first = time;
      motion = {(time - first) / periods, extreme};  // the mean period and the last swing
      extreme = 0;
      ++passages;
    }
    before = theta;
    if (step * dt > patience) FAIL("stopped rocking");
  }
  CHECK(world.most_of_a_pair == 1);
  return motion;
}

}  // namespace

TEST_CASE("the reference for rocking agrees with tests/data/README.md") {
  // tests/data/README.md: "(0.3, 0.2, 0.1), g = 9.81: exponent 2, theta0 = 0.01: 0.317495960 / 0.388773991 s (frictionless
  // / rolling); theta0 = 0.3 frictionless: 0.489837517. Exponent 3, theta0 = 0.1: 0.309433488 / 0.351081324 s."
  CHECK(Rocking{2, 0.01, false}.period() == relative(0.317495960).epsilon(1e-6));
  CHECK(Rocking{2, 0.01, true}.period() == relative(0.388773991).epsilon(1e-6));
  CHECK(Rocking{2, 0.3, false}.period() == relative(0.489837517).epsilon(1e-6));
  CHECK(Rocking{3, 0.1, false}.period() == relative(0.309433488).epsilon(1e-6));
  CHECK(Rocking{3, 0.1, true}.period() == relative(0.351081324).epsilon(1e-6));
}

TEST_CASE("an ellipsoid rocks for ten periods without friction and without slip") {
  for (const Rocking& rocking : {Rocking{2, 0.01, false}, Rocking{2, 0.01, true}, Rocking{2, 0.3, false}, Rocking{2, 0.3, true}}) {
    CAPTURE(rocking.tilt);
    CAPTURE(rocking.rolls);
    const Motion motion = rock(rocking, 1e-4);
    CHECK(motion.period == relative(rocking.period()).epsilon(3e-4));  // in proportion to the step
    CHECK(motion.amplitude == relative(rocking.tilt).epsilon(2e-3));
  }
}

TEST_CASE("a superellipsoid of exponent 3 rocks for ten periods without friction and without slip") {
  // The middle of its face is flat. The contact point passes there with infinite speed (as the inverse root of the tilt), and ODE's
  // first-order steps lose amplitude there. With half the step the loss is half as large, so it is ODE's loss and not the contact
  // point's. Extrapolated to a step of zero, the amplitude stays.
  for (const Rocking& rocking : {Rocking{3, 0.1, false}, Rocking{3, 0.1, true}}) {
    CAPTURE(rocking.rolls);
    const Motion coarse = rock(rocking, 4e-5);
    const Motion fine = rock(rocking, 2e-5);
    CHECK(fine.period == relative(rocking.period()).epsilon(3e-3));
    CHECK(fine.amplitude == relative(rocking.tilt).epsilon(0.01));
    CHECK(2 * fine.amplitude - coarse.amplitude == relative(rocking.tilt).epsilon(2e-3));
  }
}

TEST_CASE_FIXTURE(OdeSession, "tumbling bodies do not gain energy from a plane with friction") {
  World world;
  world.add_plane();
  world.set_friction(0.5);
  struct Tumbler {
    double exponent;
    double gain;  ///< allowed gain, relative to the energy at the start
    dBodyID body = nullptr;
    double start = 0, least = 0, risen = 0;
  };
  // A rolling body gains and loses energy in proportion to the step, because of ODE's integrator (the ellipsoid 0.5 % here, and 4 %
  // with steps of 2 ms). The flat bodies come to rest.
  std::array<Tumbler, 5> tumblers = {{{1.5, 0.01}, {2, 0.01}, {3, 0.01}, {8, 2e-4}, {20, 2e-4}}};
  Random random(7);
  for (std::size_t i = 0; i < tumblers.size(); ++i) {
    Tumbler& tumbler = tumblers[i];
    const auto e = dReal(tumbler.exponent);
    const dGeomID geom = snCreateSuperellipsoid(world.space(), dReal(0.1), dReal(0.07), dReal(0.05), e, e);
    tumbler.body = world.add(geom, 1000);
    random.turn(geom);
    dBodySetPosition(tumbler.body, dReal(100.0 * static_cast<double>(i)), 0, dReal(0.3));  // they never meet
    const Vec w = 10.0 * random.direction();
    dBodySetAngularVel(tumbler.body, dReal(w[0]), dReal(w[1]), dReal(w[2]));
    dBodySetLinearVel(tumbler.body, 0, dReal(random.uniform(-1, 1)), 0);
    tumbler.start = tumbler.least = energy(tumbler.body);
  }
  for (int step = 0; step < draws(100000); ++step) {
    world.quick_step(5e-4);
    for (Tumbler& tumbler : tumblers) {
      const double now = energy(tumbler.body);
      tumbler.risen = std::max(tumbler.risen, now - tumbler.least);
      tumbler.least = std::min(tumbler.least, now);
    }
  }
  for (const Tumbler& tumbler : tumblers) {
    CAPTURE(tumbler.exponent);
    CHECK(tumbler.risen < tumbler.gain * tumbler.start);
    CHECK(tumbler.least < 0.9 * tumbler.start);  // the impacts took some energy
  }
}
