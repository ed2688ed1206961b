// Bonds, against beams, chains and strengths in closed form.
#include "world/bonds.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "advise/doubts.hpp"
#include "advise/forecast.hpp"
#include "advise/refusals.hpp"
#include "common/input_error.hpp"
#include "observe/energy.hpp"
#include "observe/measurement.hpp"
#include "observe/simulation.hpp"
#include "output/frame.hpp"
#include "output/lammps_input.hpp"
#include "scenes.hpp"
#include "support/temporary_folder.hpp"

using namespace falling_particles;

namespace {

constexpr double kGravity = 9.81;  // m/s^2
constexpr double kRadius = 2e-3;   // m, of rods and of their bonds
constexpr double kSpacing = 8e-3;  // m
constexpr double kStep = 2.5e-4;   // s

constexpr const char* kKinds = R"([rod]
shape = "capsule"
radius = 2e-3
length = 8e-3
density = 1200
source = "test"
[ball]
half_axes = [3e-3, 3e-3, 3e-3]
delta = 2
epsilon = 2
density = 7800
source = "test"
[cube]
half_axes = [3e-3, 3e-3, 3e-3]
delta = 8
epsilon = 8
density = 1000
source = "test"
[clump]
density = 2500
source = "test"
parts = [{ half_axes = [3e-3, 3e-3, 3e-3] }, { half_axes = [3e-3, 3e-3, 3e-3], position = [4e-3, 0, 0] }]
)";

constexpr const char* kBondedText = R"(seed = 1
catalogue = "grains.toml"
[container]
kind = "none"
start = { corner = [-0.1, -0.1, -0.1], size = [1, 1, 1] }
bounds = { corner = [-10, -10, -10], size = [20, 20, 20] }
[start]
file = "state.csv"
overlap = 1
[[grain]]
name = "rod"
[[grain]]
name = "ball"
[[grain]]
name = "cube"
[[grain]]
name = "clump"
[time]
duration = 1
step = 2.5e-4
frame = 0.01
[solver]
iterations = 60
erp = 0.2
cfm = 1e-10
[gravity]
acceleration = [0, 0, -9.81]
[[part]]
name = "far"
shape = "plane"
position = [0, 0, -9]
)";

constexpr const char* kClamp = R"([[part]]
name = "clamp"
shape = "plane"
axis = [0, 1, 0]
angle = 90
)";

std::string bond(const std::string& name, const std::string& keys) {
  return "[[bond]]\nname = \"" + name + "\"\nkind = \"beam\"\nmodulus = 2e8\npoisson_ratio = 0.3\nradius = 2e-3\n" + keys;
}

/// A beam of rods along x, from the clamp at x = 0.
std::string clamped_beam(const std::string& keys = "") {
  return kClamp + bond("clamped", "part = \"clamp\"\ntouching = 0.01\n" + keys) + bond("beam", "touching = 0.01\n" + keys);
}

std::string rod_at(double x) { return "rod," + shortest(x) + ",0,0,0.7071067811865476,0,0.7071067811865476,0\n"; }
std::string grain_at(const std::string& kind, double x, double y, double z) {
  return kind + ',' + shortest(x) + ',' + shortest(y) + ',' + shortest(z) + ",1,0,0,0\n";
}

std::string rods(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += rod_at(6e-3 + i * kSpacing);
  return text;
}

/// A scene with grains that start at rest; `sections` follow the others.
Scene scene_with(const TemporaryFolder& folder, const std::string& grains, const std::string& sections,
                 const std::vector<std::string>& overrides = {}) {
  folder.write("grains.toml", kKinds);
  folder.write("state.csv", "grain,x_m,y_m,z_m,qw,qx,qy,qz\n" + grains);
  return load_scene(folder.write("scene.toml", kBondedText + sections), overrides);
}

struct Run {
  Run(const std::string& grains, const std::string& sections, const std::vector<std::string>& overrides = {})
      : scene(scene_with(folder, grains, sections, overrides)), simulation(scene, 1) {}

  void step() { simulation.advance(++steps * scene.time.step); }
  void advance(double seconds) {
    for (const int end = steps + static_cast<int>(std::lround(seconds / scene.time.step)); steps < end;) step();
  }
  const Grain& grain(std::size_t index) const { return simulation.world.grains()[index]; }
  const Bonds& bonds() const { return *simulation.world.bonds(); }
  std::string cause(std::size_t index) const {
    const BondBreak& failure = bonds().breaks().at(index);
    return cause_of(failure, scene.bonds[bonds().all()[failure.bond].rule]);
  }
  std::string table(const char* name) const {
    const auto measurement = find_measurement_kind(name)->on_by_default->make(simulation.world);
    TableText text;
    measurement->measure({steps * scene.time.step, simulation.world, {}, &simulation}, text);
    return measurement->columns() + '\n' + text.text();
  }

  TemporaryFolder folder;
  Scene scene;
  Simulation simulation;
  int steps = 0;
};

constexpr const char* kAtRest = "[damping]\nlinear = 20\nangular = 20\n";
const double kArea = std::numbers::pi * kRadius * kRadius;   // m^2
const double kSecondMoment = kArea * kRadius * kRadius / 4;  // m^4
const double kBending = 2e8 * kSecondMoment;                 // N m^2, E I

/// m, of the end of a cantilever by loads (N) at distances (m) from the clamp; Euler and Bernoulli.
double deflection(const std::vector<double>& places, const std::vector<double>& loads) {
  const double end = places.back();
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) sum += loads[i] * places[i] * places[i] * (3 * end - places[i]) / (6 * kBending);
  return sum;
}

/// The largest difference of the positions of two worlds' grains, m.
double difference(const WorldState& a, const WorldState& b) {
  REQUIRE(a.grains.size() == b.grains.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.grains.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, std::abs(a.grains[i].position[k] - b.grains[i].position[k]));
  }
  return largest;
}

}  // namespace

TEST_CASE("bonds: a cantilever bends under its weight as Euler and Bernoulli say") {
  Run run(rods(10), clamped_beam() + kAtRest);
  run.advance(1);
  std::vector<double> places, loads;
  for (std::size_t i = 0; i < 10; ++i) {
    places.push_back(6e-3 + static_cast<double>(i) * kSpacing);
    loads.push_back(kGravity * run.grain(i).mass.mass);
  }
  const double measured = -run.grain(9).position()[2];
  CHECK(measured == doctest::Approx(deflection(places, loads)).epsilon(0.005));  // shear adds 0.2 %
  // A uniform weight from the clamp to half a spacing beyond the last centre.
  const double length = places.back() + kSpacing / 2;
  const double weight = loads[0] / kSpacing;
  const double at = places.back();
  CHECK(measured ==
        doctest::Approx(weight * at * at * (6 * length * length - 4 * length * at + at * at) / (24 * kBending)).epsilon(0.02));
  CHECK(run.simulation.stepper.contacts() == 0);
}

TEST_CASE("bonds: the deflection does not depend on the iterations of the solver") {
  Run few(rods(10), clamped_beam() + kAtRest, {"solver.iterations=45"});
  Run many(rods(10), clamped_beam() + kAtRest, {"solver.iterations=1000"});
  few.advance(1.5);
  many.advance(1.5);
  CHECK(few.grain(9).position()[2] == doctest::Approx(many.grain(9).position()[2]).epsilon(1e-4));
}

TEST_CASE("bonds: a beam swings with the frequency of its stiffness and masses") {
  // Hermite's elements between the centres, with the masses and inertias of the rods.
  constexpr int kCount = 10;
  Run run(rods(kCount), clamped_beam());
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(2 * kCount + 2, 2 * kCount + 2);
  Eigen::MatrixXd mass = stiffness;
  for (int i = 0; i < kCount; ++i) {
    const double length = i == 0 ? 6e-3 : kSpacing;
    const double l = length;
    Eigen::Matrix4d element;
    element << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l, -6 * l,
        4 * l * l;
    stiffness.block<4, 4>(2 * i, 2 * i) += kBending / (l * l * l) * element;
    const dMass& of_rod = run.grain(static_cast<std::size_t>(i)).mass;
    mass(2 * i + 2, 2 * i + 2) = of_rod.mass;
    mass(2 * i + 3, 2 * i + 3) = of_rod.I[0];
  }
  // The slowest mode, by inverse iteration: the next is six times as fast, so each iteration leaves 1/40 of the rest.
  const Eigen::MatrixXd of_modes = mass.bottomRightCorner(2 * kCount, 2 * kCount);
  const Eigen::LLT<Eigen::MatrixXd> solver(stiffness.bottomRightCorner(2 * kCount, 2 * kCount));
  Eigen::VectorXd mode = Eigen::VectorXd::Ones(2 * kCount);
  double growth = 0;  // s^2
  for (int i = 0; i < 20; ++i) {
    mode = solver.solve(of_modes * mode).eval();
    growth = mode.norm();
    mode /= growth;
  }
  const double period = 2 * std::numbers::pi * std::sqrt(growth);
  std::vector<double> places, loads;
  for (std::size_t i = 0; i < kCount; ++i) {
    places.push_back(6e-3 + static_cast<double>(i) * kSpacing);
    loads.push_back(kGravity * run.grain(i).mass.mass);
  }
  // Released from rest, the end swings about its deflection at rest.
  const double level = -deflection(places, loads);
  std::vector<double> passes;  // s, downwards
  for (double before = 0; passes.size() < 4;) {
    run.step();
    const double now = run.grain(kCount - 1).position()[2];
    if (before > level && now <= level) passes.push_back((run.steps - (level - now) / (before - now)) * kStep);
    before = now;
  }
  CHECK((passes[3] - passes[0]) / 3 == doctest::Approx(period).epsilon(0.01));
}

TEST_CASE("bonds: a chain of balls hangs as a funicular of its links") {
  // Two parts move together until the span is 0.8 of the chain's length.
  constexpr int kCount = 30;
  constexpr double kSpan = 0.8 * kCount * kSpacing;
  const double shortening = kCount * kSpacing - kSpan;
  std::string grains;
  for (int i = 0; i < kCount; ++i) grains += rod_at((i + 0.5) * kSpacing);
  const auto post = [&](const char* name, double x, double speed) {
    return std::string("[[part]]\nname = \"") + name + "\"\nshape = \"box\"\nsize = [2e-3, 2e-3, 2e-3]\nposition = [" +
           shortest(x) + ", 0, 0]\n[[part.motion]]\nkind = \"velocity\"\nvelocity = [" + shortest(speed) +
           ", 0, 0]\nuntil = 0.5\n" + "[[bond]]\nname = \"" + name +
           "\"\nkind = \"ball\"\nmodulus = 1e7\nradius = 1e-3\npart = \"" + name + "\"\ntouching = 1.01\n";
  };
  // A post is half a spacing beyond the cap, so that the ball is in the middle of the cap.
  Run run(grains,
          post("left", -kSpacing / 2 - 1e-3, shortening) + post("right", kCount * kSpacing + kSpacing / 2 + 1e-3, -shortening) +
              "[[bond]]\nname = \"chain\"\nkind = \"ball\"\nmodulus = 1e7\nradius = 1e-3\ntouching = 0.01\n" + kAtRest,
          {"time.step=5e-4", "time.duration=4"});
  REQUIRE(run.bonds().all().size() == kCount + 1);
  run.advance(4);
  // A link between two balls has the slope weight above it / horizontal force at its middle.
  const double weight = kGravity * run.grain(0).mass.mass;
  const auto span = [&](double force) {
    double sum = 0;
    for (int i = 0; i < kCount; ++i) sum += kSpacing * std::cos(std::atan(weight * (i - (kCount - 1) / 2.0) / force));
    return sum;
  };
  double low = 1e-6, high = 10;
  for (int i = 0; i < 100; ++i) (span((low + high) / 2) < kSpan ? low : high) = (low + high) / 2;
  double sag = 0;
  for (int i = 0; i < kCount / 2; ++i) sag += kSpacing * std::sin(std::atan(weight * ((kCount - 1) / 2.0 - i) / low));
  const double middle = -(run.grain(kCount / 2 - 1).position()[2] + run.grain(kCount / 2).position()[2]) / 2;
  const double to_centre =
      kSpacing / 2 * std::sin(std::atan(weight / 2 / low));  // the ball in the middle is lower than the centres
  CHECK(middle + to_centre == doctest::Approx(sag).epsilon(0.01));
}

TEST_CASE("bonds: a bond breaks above its strength, by the cause that is largest") {
  const double weight = kGravity * 7800 * 4 / 3 * std::numbers::pi * 27e-9;  // N, of a ball
  const auto hang = [&](const std::string& keys) {
    // A clamp above: grains are below the plane z = 0.
    return Run(grain_at("ball", 0, 0, -3e-3), "[[part]]\nname = \"ceiling\"\nshape = \"plane\"\naxis = [1, 0, 0]\nangle = 180\n" +
                                                  bond("glue", "part = \"ceiling\"\ntouching = 0.01\ndamping = 1\n" + keys));
  };
  const auto stick_out = [&](const std::string& keys) {
    return Run(grain_at("ball", 3e-3, 0, 0), kClamp + bond("glue", "part = \"clamp\"\ntouching = 0.01\ndamping = 1\n" + keys));
  };
  const auto breaks = [](Run&& run, const char* cause) {
    run.advance(0.1);
    if (run.bonds().breaks().empty()) return false;
    CHECK(run.cause(0) == cause);
    CHECK(run.bonds().intact() == 0);
    return true;
  };
  const auto strength = [](const char* key, double pascal) { return std::string(key) + " = " + shortest(pascal) + '\n'; };
  // A load that comes at once swings; with the critical damping it ends at the weight with less than a tenth of overshoot.
  CHECK(!breaks(hang(strength("tensile_strength", 1.2 * weight / kArea)), ""));
  CHECK(breaks(hang(strength("tensile_strength", 0.95 * weight / kArea)), "tension"));
  CHECK(!breaks(hang(strength("shear_strength", 0.01 * weight / kArea)), ""));
  const double bending = weight * 3e-3 * kRadius / kSecondMoment;  // Pa, at the clamp
  CHECK(!breaks(stick_out(strength("tensile_strength", 1.2 * bending)), ""));
  CHECK(breaks(stick_out(strength("tensile_strength", 0.95 * bending)), "bending"));
  CHECK(!breaks(stick_out(strength("shear_strength", 1.2 * weight / kArea)), ""));
  CHECK(breaks(stick_out(strength("shear_strength", 0.95 * weight / kArea)), "shear"));
}

TEST_CASE("bonds: bonded grains do not collide until their bond breaks") {
  const std::string floor = "[[part]]\nname = \"floor\"\nshape = \"plane\"\nposition = [0, 0, -3e-3]\n";
  const std::string pair = grain_at("ball", 0, 0, 0) + grain_at("ball", 0, 0, 6e-3);
  {
    const auto most_contacts = [](Run&& run) {
      std::size_t most = 0;
      for (int i = 0; i < 200; ++i) {
        run.step();
        most = std::max(most, run.simulation.stepper.contacts());
      }
      return most;
    };
    CHECK(most_contacts(Run(pair, floor + bond("glue", "touching = 0.01\n"))) == 1);  // with the floor
    CHECK(most_contacts(Run(pair, floor + bond("glue", "touching = 0.01\ncontacts = true\n"))) == 2);
  }
  // The lower ball stands; the upper one, which is pushed, breaks off and slides on it.
  Run broken(pair, floor + bond("glue", "chain = [0, 1]\nshear_strength = 1e-3\n"));
  dBodySetLinearVel(broken.grain(1).body, 0.01, 0, 0);
  broken.advance(0.02);
  REQUIRE(broken.bonds().breaks().size() == 1);
  CHECK(broken.grain(1).position()[2] == doctest::Approx(6e-3).epsilon(0.01));
}

TEST_CASE("bonds: grains that overlap when their bond breaks come apart without a jump") {
  // Rods in one another, pulled apart by the weight of the lower one.
  const std::string ceiling = "[[part]]\nname = \"ceiling\"\nshape = \"plane\"\naxis = [1, 0, 0]\nangle = 180\n";
  const std::string bonds =
      bond("held", "part = \"ceiling\"\ntouching = 0.01\n") + bond("weak", "chain = [0, 1]\ntensile_strength = 1\n");
  for (const std::string contacts : {"", "[speculative_contacts]\n"}) {
    Run run("rod,0,0,-6e-3,1,0,0,0\nrod,0,0,-14e-3,1,0,0,0\n", std::string(ceiling).append(bonds).append(contacts));
    CHECK(measure_overlap(run.simulation.world).pairs == 0);  // bonded grains do not count
    double fastest = 0;
    for (int i = 0; i < 400; ++i) {
      run.step();
      fastest = std::max(fastest, -run.grain(1).velocity()[2]);
      CHECK(-run.grain(1).velocity()[2] <= kGravity * run.steps * kStep + 1e-9);  // no faster than in free fall
    }
    CHECK(run.bonds().breaks().size() == 1);
    CHECK(fastest == doctest::Approx(kGravity * 400 * kStep).epsilon(0.02));
    CHECK(run.simulation.stepper.contacts() == 0);
  }
}

TEST_CASE("bonds: a compound is bonded by its nearest component, from its centre of mass") {
  Run run(grain_at("clump", 0, 0, 0) + grain_at("ball", 8e-3, 0, 0), bond("glue", "touching = 0.01\n"));
  REQUIRE(run.bonds().all().size() == 1);
  CHECK(run.bonds().all()[0].rest.length() == doctest::Approx(8e-3));
  run.advance(0.1);
  CHECK(run.simulation.stepper.contacts() == 0);
  const Vector3 branch = Vector3(run.grain(1).position().data()) - Vector3(run.grain(0).position().data());
  CHECK((branch - Vector3(8e-3, 0, 0)).norm() < 1e-9);  // both fall alike
}

TEST_CASE("bonds: twice the allowed stiffness is stable") {
  for (const std::string name : {"beam", "agglomerate"}) {
    CAPTURE(name);
    Scene scene = load_scene(std::string(SUPERNORMAL_SAMPLES) + "/scenes/" + name + ".toml");
    const double relative = Simulation(scene, 1).world.bonds()->stiffness().relative;
    for (BondRule& rule : scene.bonds) {
      rule.modulus *= 20 * scene.solver.iterations / relative;
      rule.tensile_strength = rule.shear_strength = BondRule::kUnbreakable;
    }
    Simulation simulation(scene, 1);
    CHECK(simulation.world.bonds()->stiffness().relative == doctest::Approx(20 * scene.solver.iterations));
    for (int i = 0; i < 400; ++i) simulation.stepper.step();
    for (const Grain& grain : simulation.world.present()) {
      CHECK(Vector3(grain.velocity().data()).norm() < 2.5);  // m/s; the anvil has 1 m/s, from which grains may bounce with 2 m/s
    }
  }
}

TEST_CASE("bonds: energy is neither gained nor lost but by damping of the step") {
  Run run(rods(4) + grain_at("cube", 35e-3, 0, 0), bond("beam", "touching = 0.01\n"),
          {"gravity.acceleration=[0, 0, 0]", "time.step=1e-6", "bond[beam].modulus=1e5"});
  dBodySetLinearVel(run.grain(0).body, 0, 0.05, 0.02);
  dBodySetAngularVel(run.grain(4).body, 3, 0, 0);
  const double start = measure_energy(run.simulation.world, run.scene).total();
  run.advance(0.01);
  const Energy end = measure_energy(run.simulation.world, run.scene);
  CHECK(end.total() < 1.001 * start);
  CHECK(end.total() > 0.93 * start);
  Vector3 momentum = Vector3::Zero();
  for (const Grain& grain : run.simulation.world.present()) momentum += grain.mass.mass * Vector3(grain.velocity().data());
  CHECK((momentum - run.grain(0).mass.mass * Vector3(0, 0.05, 0.02)).norm() < 1e-6 * momentum.norm());
}

TEST_CASE("bonds: a pair that spins keeps its momentum and its angular momentum") {
  // The bond stretches by up to 2 % of its length, and a step turns it by up to 0.1 rad.
  struct Case {
    const char* kind;
    double spin, modulus, step;  // rad/s, Pa, s
  };
  for (const Case& one :
       {Case{"beam", 100, 1e5, 1e-4}, Case{"beam", 100, 1e7, 1e-3}, Case{"beam", 1000, 1e7, 1e-4}, Case{"ball", 1000, 1e7, 1e-4}}) {
    CAPTURE(one.kind);
    CAPTURE(one.modulus);
    CAPTURE(one.step);
    std::string glue = bond("glue", "touching = 0.01\n");
    if (std::string(one.kind) == "ball") {
      glue = "[[bond]]\nname = \"glue\"\nkind = \"ball\"\nmodulus = 2e8\nradius = 2e-3\ntouching = 0.01\n";
    }
    Run run(grain_at("ball", -3e-3, 0, 0) + grain_at("ball", 3e-3, 0, 0), glue,
            {"gravity.acceleration=[0, 0, 0]", "bond[glue].modulus=" + shortest(one.modulus), "time.step=" + shortest(one.step)});
    const Vector3 velocity(0.1, 0, 0.05);  // m/s
    for (const std::size_t i : {0U, 1U}) {
      const dBodyID body = run.grain(i).body;
      dBodySetLinearVel(body, velocity.x(), one.spin * run.grain(i).position()[0], velocity.z());
      dBodySetAngularVel(body, 0, 0, one.spin);
    }
    const auto momenta = [&] {
      const Vector3 centre = (Vector3(run.grain(0).position().data()) + Vector3(run.grain(1).position().data())) / 2;
      Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();  // N s, N m s
      for (const std::size_t i : {0U, 1U}) {
        const dReal* turning = dBodyGetAngularVel(run.grain(i).body);
        const Vector3 momentum = run.grain(i).mass.mass * Vector3(run.grain(i).velocity().data());
        linear += momentum;
        angular += (Vector3(run.grain(i).position().data()) - centre).cross(momentum) +
                   run.grain(i).mass.I[0] * Vector3(turning[0], turning[1], turning[2]);
      }
      return std::pair(linear, angular);
    };
    const auto [linear, angular] = momenta();
    run.advance(0.2);
    const auto [linear_now, angular_now] = momenta();
    CHECK((linear_now - linear).norm() < 1e-10 * linear.norm());
    CHECK((angular_now - angular).norm() < 1e-10 * angular.norm());
    CHECK(run.bonds().intact() == 1);
  }
}

TEST_CASE("bonds: a pair that spins faster and faster breaks when the centripetal force exceeds its strength, for any step") {
  // At 100 rad/s a step turns the pair by 0.01 rad. Its poses are stretched by half the square, 50 kPa; the force is 2.1 kPa.
  const double mass = 7800 * 4 / 3.0 * std::numbers::pi * 27e-9;  // kg, of a ball
  const double strength = mass * 1e4 * 3e-3 / kArea;              // Pa
  const auto spin_at_break = [&](const std::string& damping) {
    Run run(grain_at("ball", -3e-3, 0, 0) + grain_at("ball", 3e-3, 0, 0),
            bond("glue", "touching = 0.01\n" + damping + "tensile_strength = " + shortest(strength) + '\n'),
            {"gravity.acceleration=[0, 0, 0]", "bond[glue].modulus=1e9", "time.step=1e-4"});
    constexpr double kSpinUp = 1000;  // rad/s^2
    while (run.bonds().breaks().empty() && run.steps < 2000) {
      const Vector3 arm = (Vector3(run.grain(1).position().data()) - Vector3(run.grain(0).position().data())) / 2;
      const Vector3 force = mass * kSpinUp * Vector3::UnitZ().cross(arm);
      for (const std::size_t i : {0U, 1U}) {
        const double sign = i == 0 ? -1 : 1;
        dBodyAddForce(run.grain(i).body, sign * force.x(), sign * force.y(), 0);
        dBodyAddTorque(run.grain(i).body, 0, 0, kSpinUp * run.grain(i).mass.I[0]);
      }
      run.step();
    }
    REQUIRE(run.bonds().breaks().size() == 1);
    CHECK(run.cause(0) == "tension");
    return dBodyGetAngularVel(run.grain(0).body)[2];
  };
  CHECK(spin_at_break("") == doctest::Approx(100).epsilon(0.02));
  CHECK(spin_at_break("damping = 1\n") == doctest::Approx(100).epsilon(0.02));
}

TEST_CASE("bonds: a grain follows the part that it is bonded to") {
  Run run(grain_at("cube", 0.05, 0, 0),
          "[[part]]\nname = \"arm\"\nshape = \"box\"\nsize = [0.094, 0.01, 0.01]\n[[part.motion]]\nkind = \"rotation\"\naxis = [0, "
          "0, 1]\n"
          "point = [0, 0, 0]\nrpm = 60\n" +
              bond("glue", "part = \"arm\"\ntouching = 0.01\ndamping = 1\n"),
          {"gravity.acceleration=[0, 0, 0]"});
  run.advance(1.25);  // a turn and a quarter
  CHECK(std::abs(run.grain(0).position()[0]) < 5e-4);
  CHECK(run.grain(0).position()[1] == doctest::Approx(0.05).epsilon(0.01));
}

TEST_CASE("bonds: a sink that removes a grain removes its bonds") {
  Run run(rods(3), bond("beam", "touching = 0.01\n") + "[[sink]]\nname = \"out\"\npoint = [18e-3, 0, 0]\nnormal = [-1, 0, 0]\n");
  run.advance(0.01);
  CHECK(run.simulation.world.present().size() == 2);
  CHECK(run.bonds().intact() == 1);
  CHECK(run.cause(0) == "removed");
  const Contents pictures = contents_of(run.simulation.world, run.scene);
  REQUIRE(pictures.bonds.size() == 2);
  CHECK((pictures.bonds[0].first == 0 && pictures.bonds[0].second == 1));
  CHECK(pictures.bonds[0].until == std::numeric_limits<double>::infinity());
  CHECK(pictures.bonds[1].until == run.bonds().breaks()[0].time);
}

TEST_CASE("bonds: a run goes on from final_state.csv and final_bonds.csv") {
  Run run(rods(10), clamped_beam("damping = 0.1\n"));
  run.advance(0.02);  // it bends
  const TemporaryFolder folder;
  folder.write("grains.toml", kKinds);
  folder.write("state.csv", run.table("final_state"));
  folder.write("bonds.csv", run.table("final_bonds"));
  const Scene scene = load_scene(folder.write("scene.toml", kBondedText + clamped_beam("damping = 0.1\n")),
                                 {"bond[clamped].file=\"bonds.csv\"", "bond[beam].file=\"bonds.csv\""});
  Simulation simulation(scene, 1);
  CHECK(simulation.world.bonds()->all().size() == 10);
  CHECK(simulation.world.bonds()->energy() == doctest::Approx(run.bonds().energy()).epsilon(1e-6));
  run.advance(0.01);
  for (int i = 0; i < 40; ++i) simulation.stepper.step();
  CHECK(difference(simulation.world.save(), run.simulation.world.save()) < 1e-7);
}

TEST_CASE("bonds: a scene without them has none") {
  const Run run(rods(1), "");
  CHECK(run.simulation.world.bonds() == nullptr);
  CHECK(!find_measurement_kind("bonds")->is_on(run.scene));
}

TEST_CASE("bonds: the forecast counts them by section") {
  const TemporaryFolder folder;
  const Scene scene = scene_with(folder, rods(4), clamped_beam());
  const Forecast found = forecast(scene);
  CHECK(found.bonds == std::vector<std::uint64_t>{1, 3});
  CHECK(describe(scene, found).find("clamped: 1 bond\n") != std::string::npos);
}

TEST_CASE("bonds: LAMMPS' input refuses them") {
  const TemporaryFolder folder;
  const Scene scene =
      scene_with(folder, grain_at("ball", 0, 0, 0) + grain_at("ball", 6e-3, 0, 0), bond("glue", "touching = 0.01\n"));
  check_says(refusal_by([&] { lammps_input(scene); }), {"[[bond]] has no counterpart in LAMMPS' input: leave it out"});
}

namespace {

/// What a bonded scene is made of, beside its sections.
struct BondedStart {
  std::string grains = rods(3);
  std::vector<std::string> overrides = {};
  std::string file = "body_1,body_2\n0,1\n1,2\n";  // bonds.csv
};

/// What the loader or the check says.
std::string refusal_of(const std::string& sections, const BondedStart& start = {}) {
  const TemporaryFolder folder;
  folder.write("bonds.csv", start.file);
  return refusal_by([&] { refuse_bad_start(scene_with(folder, start.grains, sections, start.overrides)); });
}

}  // namespace

TEST_CASE("bonds: a step that damps more than the scene asks is told where bonds may break") {
  const auto told = [](const std::string& keys, const std::vector<std::string>& overrides = {}) {
    const TemporaryFolder folder;
    std::vector<std::string> doubts;
    add_doubts_about_bonds(scene_with(folder, rods(3), bond("glue", "touching = 0.01\n" + keys), overrides), doubts);
    return doubts;
  };
  CHECK(told("damping = 0.05\n").empty());  // nothing breaks
  const std::vector<std::string> damped = told("damping = 0.05\ntensile_strength = 1e6\n");
  REQUIRE(damped.size() == 1);
  check_says(damped[0], {"bond \"glue\": a step damps its fastest motions by ", "besides bond.damping = 0.05", "time.step up to "});
  const double step = std::stod(damped[0].substr(damped[0].find("time.step up to ") + 16));
  CHECK(told("damping = 0.05\ntensile_strength = 1e6\n", {"time.step=" + shortest(1.1 * step)}).size() == 1);
  CHECK(told("damping = 0.05\ntensile_strength = 1e6\n", {"time.step=" + shortest(0.9 * step)}).empty());
  check_says(told("shear_strength = 1e6\n").at(0), {"besides bond.damping = 0", "half the time.step damps half as much"});
}

TEST_CASE("bonds: mistakes are refused with their name, value and range") {
  CHECK(refusal_of(bond("glue", "touching = 0.01\n")).empty());
  CHECK(refusal_of(bond("glue", "file = \"bonds.csv\"\n")).empty());
  const auto says = [](const std::string& sections, const std::vector<const char*>& parts) {
    check_says(refusal_of(sections), parts);
  };
  const std::string touching = "touching = 0.01\n";
  says("[[bond]]\nname = \"a\"\nkind = \"beem\"\n", {"bond.kind is \"beem\"", "did you mean \"beam\"?", "allowed: beam, ball"});
  says(bond("glue", touching + "tensile_strength = -1\n"), {"bond.tensile_strength is -1; allowed: a number in (0, 1e+15] Pa"});
  says(bond("glue", touching + "damping = 2\n"), {"bond.damping is 2; allowed: a number in [0, 1]"});
  says(bond("glue", touching + "relative_radius = 1\n"), {"bond.relative_radius beside bond.radius"});
  says(bond("glue", ""), {"bond \"glue\" has no pairs; allowed: one of touching, chain and file"});
  says(bond("glue", touching + "chain = [0, 1]\n"),
       {"bond \"glue\" has both touching and chain; allowed: one of touching, chain and file"});
  says(bond("glue", "chain = [0, 3]\n"), {"bond.chain: grain 3 is not in start.file; allowed: its numbers, from 0 to 2"});
  says(bond("glue", "chain = [1, 1]\n"), {"bond.chain is [1, 1]; allowed: the whole numbers of two grains, the smaller one first"});
  says(bond("glue", "chain = [0, 1]\n") + bond("more", "chain = [0, 2]\n"), {"grain 0 and grain 1 have two bonds; allowed: one"});
  says(bond("glue", touching) + bond("glue", touching), {"bond.name is \"glue\", which another bond has"});
  says(bond("glue", touching + "part = \"wall\"\n"), {"bond.part is \"wall\"; allowed: a part of the scene: far"});
  says(bond("glue", "file = \"no.csv\"\n"), {"bond.file: there is no file", "no.csv"});
  says(bond("beam", touching) + bond("glue", touching + "part = \"far\"\n"),
       {"bond \"glue\" bonds nothing: no grain and part of the start are closer than bond.touching = 0.01"});
  says(
      "[[part]]\nname = \"piston\"\nshape = \"box\"\nsize = [1e-2, 1e-2, 1e-2]\nposition = [0, 0, -1]\ndrive = {axis = [0, 0, 1], "
      "force = 1, mass = 1}\n" +
          bond("glue", touching + "part = \"piston\"\n"),
      {"bond.part is \"piston\", which a force drives; allowed: a part that stands or has motions"});
  says("[periodic]\nx = [-0.5, 1]\n" + bond("glue", touching), {"[[bond]] in a scene that repeats"});
  const auto of_file = [](const std::string& file) { return refusal_of(bond("glue", "file = \"bonds.csv\"\n"), {.file = file}); };
  check_says(of_file("body_1,body_2\n0,7\n"), {"bonds.csv:2: grain 7 is not in start.file; allowed: its numbers, from 0 to 2"});
  check_says(of_file("body_1,body_2\n1,1\n"), {"bonds.csv:2: grain 1 is bonded to itself; allowed: two grains"});
  check_says(of_file("body_1,body_2,start_x_m,start_y_m,start_z_m,x_m,y_m,z_m,qw,qx,qy,qz\n0,1,0,0,0,0,0,0,1,0,0,0\n"),
             {"bonds.csv:2: the length of the bond is 0 m; allowed: above 0"});
  check_says(of_file("body_1,body_2,bond\n0,1,other\n"),
             {"no line has \"glue\" in its column bond", "if all its bonds are broken, leave the section out"});
}

TEST_CASE("bonds: a start of grains in one place, and one without a state, are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(scene_with(folder, rod_at(0) + rod_at(0), bond("glue", "chain = [0, 1]\n")),
                       doctest::Contains("the length from grain 0 to grain 1 is 0 m; allowed: above 0, between two centres"),
                       InputError);
  check_says(complaint(std::string(kSceneText) + bond("glue", "chain = [0, 1]\n")),
             {"bond.chain without [start]; allowed: with it, since [drop] shuffles the grains"});
}

TEST_CASE("bonds: bonds that join grains of one place by their touching are refused") {
  const std::string glue = bond("glue", "touching = 0.01\n");
  check_says(refusal_of(glue, {.grains = grain_at("ball", 0, 0, 0) + grain_at("ball", 0, 0, 0)}),
             {"bond \"glue\": the length from grain 0 to grain 1 (ball) is 0 m; allowed: from 3e-09 m on, between two centres"});
  check_says(refusal_of(glue, {.grains = grain_at("ball", 0, 0, 0) + grain_at("ball", 1e-12, 0, 0)}),
             {"is 1e-12 m; allowed: from 3e-09 m on"});
  const std::string plane = std::string(kClamp) + bond("glue", "part = \"clamp\"\ntouching = 0.01\n");
  check_says(refusal_of(plane, {.grains = grain_at("ball", 0, 0, 0)}),
             {"the length from part clamp to grain 0 (ball) is", "the surface of a part"});
  // Short bonds that are not so short are too stiff; of iterations, only as many as a scene may have are offered.
  const std::string stiff = refusal_of(glue, {.grains = grain_at("ball", 0, 0, 0) + grain_at("ball", 1e-8, 0, 0)});
  check_says(stiff, {"bond \"glue\" is too stiff for grain", "or time.step up to "});
  CHECK(stiff.find("iterations") == std::string::npos);
}

TEST_CASE("bonds: bonds that are too stiff for the step are refused with what would do") {
  const std::string said = refusal_of(bond("glue", "touching = 0.01\n"), {.overrides = {"bond[glue].modulus=1e11"}});
  check_says(said, {"bond \"glue\" is too stiff for grain 1 (rod): bond.modulus is 1e+11 Pa, and its radius 0.002 m; allowed: ",
                    "bond.modulus up to ", " Pa, a smaller radius, or time.step up to ", " s, or solver.iterations from "});
  const std::string number = said.substr(said.find("iterations from ") + 16);
  CHECK(refusal_of(bond("glue", "touching = 0.01\n"),
                   {.overrides = {"bond[glue].modulus=1e11", "solver.iterations=" + std::to_string(std::stoi(number))}})
            .empty());
}

TEST_CASE("bonds: a radius of a file that is too large for the step is named with its line") {
  check_says(refusal_of(replaced(bond("glue", "file = \"bonds.csv\"\n"), "radius = 2e-3\n", ""),
                        {.file = "body_1,body_2,radius_m\n0,1,1e-4\n1,2,0.5\n"}),
             {"bonds.csv:3: bond \"glue\" is too stiff for grain", "and its radius 0.5 m; allowed: bond.modulus up to"});
}

TEST_CASE("bonds: a beam has six rows in a step and a ball three, and a pair that sleeps has none") {
  const std::string ball = replaced(bond("ball", "chain = [2, 3]\n"), "kind = \"beam\"", "kind = \"ball\"");
  Run run(rods(4), bond("beam", "chain = [0, 2]\n") + replaced(ball, "poisson_ratio = 0.3\n", ""));
  for (int i = 0; i < 5; ++i) run.step();
  CHECK(run.bonds().rows() == 5 * (2 * 6 + 3));
  for (std::size_t i = 0; i < 2; ++i) dBodyDisable(run.grain(i).body);
  run.step();
  CHECK(run.bonds().rows() == 5 * (2 * 6 + 3) + 6 + 3);
}
