#include <doctest/doctest.h>

#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "supernormal/effects.hpp"
#include "support/refusal.hpp"

using namespace supernormal::effects;

namespace {

std::string refusal(const std::vector<Effect>& list, double step = 1e-3, Solver solver = Solver::QuickStep) {
  return supernormal::test::refusal([&] { Effects(list, step, solver); });
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("an invalid parameter is refused with the effect, the parameter, its value and the range") {
  struct Case {
    Effect effect;
    const char* says;
  };
  const std::vector<Case> cases = {
      {Friction{0, {}}, "friction: coefficient = 0 is outside (0, 100]"},
      {Friction{kNan, {}}, "friction: coefficient = nan is outside (0, 100]"},
      {Friction{0.5, MaterialSelector::of(64)}, "friction: material = 64 is outside [0, 63]"},
      {Friction{0.5, MaterialSelector::between(1, -3)}, "friction: material = -3 is outside [0, 63]"},
      {AnisotropicFriction{-1, 0, {1, 0, 0}, {}}, "anisotropic_friction: along = -1 is outside [0, 100]"},
      {AnisotropicFriction{0, 0, {1, 0, 0}, {}}, "anisotropic_friction: along and across are both 0"},
      {AnisotropicFriction{1, 0, {0, 0, 0}, {}}, "anisotropic_friction: direction = (0, 0, 0) is no direction"},
      {RollingResistance{-1e-3, 0, {}}, "rolling_resistance: rolling = -0.001 m is outside [0, 1000] m"},
      {RollingResistance{0, 0, {}}, "both 0"},
      {Restitution{1.1, 0, {}}, "restitution: coefficient = 1.1 is outside (0, 1]"},
      {Restitution{1, -1, {}}, "restitution: threshold = -1 m/s is outside [0, 100] m/s"},
      {Compliance{0, 0, {}}, "compliance: stiffness = 0 N/m is outside (0, 1e+15] N/m"},
      {Compliance{1, kInfinity, {}}, "compliance: damping = inf N s/m is outside [0, 1e+15] N s/m"},
      {Hertz{1e9, 0.6, 1, {}}, "hertz: poisson_ratio = 0.6 is outside [0, 0.5]"},
      {Hertz{1e9, 0.3, 0, {}}, "hertz: restitution = 0 is outside [0.05, 1]"},
      {Adhesion{0, {}}, "adhesion: pull_off = 0 N is outside (0, 1e+09] N"},
      {Gravity{{0, 0, kNan}}, "gravity: acceleration = nan m/s^2 is outside [-10000, 10000] m/s^2"},
      {QuadraticDrag{1.2, 0}, "quadratic_drag: coefficient = 0 is outside (0, 100]"},
      {StokesDrag{-1}, "stokes_drag: viscosity = -1 Pa s is outside (0, 1e+06] Pa s"},
      {Damping{0, 0}, "damping: linear and angular are both 0"},
      {AutoDisable{0.01, 0.01, 0, 0}, "auto_disable: samples = 0 is outside [1, 1000]"},
      {MaxCorrectingVelocity{0}, "max_correcting_velocity: velocity = 0 m/s is outside (0, 1e+06] m/s"},
      {SpeculativeContacts{MaterialSelector::of(-7)}, "speculative_contacts: material = -7 is outside [0, 63]"},
      {SurfaceLayer{0}, "surface_layer: depth = 0 m is outside (0, 1000] m"},
  };
  for (const Case& c : cases) {
    const std::string text = refusal({c.effect});
    CAPTURE(text);
    CHECK(text.find(c.says) != std::string::npos);
  }
  CHECK(refusal({}, 0).find("step = 0 s is outside (0, inf) s") != std::string::npos);
}

TEST_CASE("effects that exclude one another, or lack a required one, are refused") {
  const Gravity gravity{{0, 0, -9.81}};
  CHECK(refusal({SpeculativeContacts{}, SpeculativeContacts{}}) ==
        "speculative_contacts is listed twice for the same surfaces; it must be listed once");
  CHECK(refusal({gravity, gravity}) == "gravity is listed twice; it must be listed once");
  CHECK(refusal({Friction{0.5, MaterialSelector::between(1, 2)}, Friction{0.4, MaterialSelector::between(2, 1)}}) ==
        "friction is listed twice for the same surfaces; it must be listed once");
  CHECK(refusal({Buoyancy{1000, 0}}).find("buoyancy is listed without gravity") == 0);
  CHECK(refusal({Hertz{1e9, 0.3, 1, {}}, MaxCorrectingVelocity{1}})
            .find("max_correcting_velocity is listed with compliance or hertz") == 0);
  CHECK(refusal({Hertz{1e9, 0.3, 1, {}}, Restitution{0.5, 0, {}}})
            .find("hertz and restitution are both listed for contacts of materials the others") == 0);
  CHECK(refusal({Compliance{1e9, 0, MaterialSelector::of(1)}, Hertz{1e9, 0.3, 1, MaterialSelector::of(2)}})
            .find("hertz and compliance are both listed for contacts of materials 1 and 2") == 0);
  CHECK(refusal({Compliance{1e9, 0, MaterialSelector::between(1, 1)}, Restitution{0.5, 0, MaterialSelector::of(2)}}).empty());
}

TEST_CASE("effects that act on contacts once a step are refused for a stepper") {
  const auto refused = [](const Effect& effect) { return refusal({effect}, 1e-3, Solver::Stepper); };
  CHECK(refused(Compliance{1e9, 0, {}}) ==
        "compliance is listed for a stepper, in whose sub-steps it does not act; allowed: quickstep");
  CHECK(refused(Hertz{1e9, 0.3, 1, {}}).find("hertz is listed for a stepper") == 0);
  CHECK(refused(Adhesion{1, {}}).find("adhesion is listed for a stepper") == 0);
  CHECK(refused(SpeculativeContacts{}).find("speculative_contacts is listed for a stepper, whose bodies look ahead") == 0);
  CHECK(refusal({Friction{0.5, {}}, RollingResistance{1e-3, 0, {}}, Restitution{1, 0, {}}, MaxCorrectingVelocity{1}}, 1e-3,
                Solver::Stepper)
            .empty());
}

TEST_CASE("a refusal has its reason without the contacts that it is about") {
  const auto reason = [](const std::vector<Effect>& list) -> std::string {
    try {
      const Effects effects(list, 1e-3);
    } catch (const BadEffect& error) {
      return error.reason();
    }
    return "";
  };
  const std::vector<Effect> excluded = {Hertz{1e9, 0.3, 1, {}}, Restitution{0.5, 0, {}}};
  CHECK(reason(excluded) == "hertz must be without restitution: it has one of its own");
  CHECK(refusal(excluded) ==
        "hertz and restitution are both listed for contacts of materials the others and the others; " + reason(excluded));
  CHECK(reason({Friction{0, {}}}) == refusal({Friction{0, {}}}));
}

TEST_CASE("every effect has a description") {
  CHECK(descriptions().size() == std::variant_size_v<Effect::variant>);
  for (const Description& description : descriptions()) {
    for (const char* const text : {description.name, description.passes, description.source}) {
      REQUIRE(text != nullptr);
      CHECK_FALSE(std::string(text).empty());
    }
  }
  const auto parameters_of = [](const Effect& effect) { return std::string(descriptions()[effect.index()].parameters); };
  CHECK(parameters_of(AnisotropicFriction{}) == "along, across [0, 100]; direction, of the body");
  CHECK(parameters_of(RollingResistance{}) == "rolling, spinning [0, 1e3] m, 0 without it");
  CHECK(parameters_of(Compliance{}) == "stiffness (0, 1e15] N/m; damping [0, 1e15] N s/m, 0 without it");
  CHECK(parameters_of(Hertz{}) == "youngs_modulus (0, 1e15] Pa; poisson_ratio [0, 0.5]; restitution [0.05, 1], 1 without it");
  CHECK(parameters_of(Gravity{}) == "acceleration [-1e4, 1e4] m/s^2");
  CHECK(parameters_of(SpeculativeContacts{}) == "none");
}

TEST_CASE("an effect is read by the names of its parameters") {
  const auto read = [](const char* name, const std::map<std::string, std::vector<double>>& numbers) {
    return read_effect(name, [&](const Parameter& parameter) {
      const auto found = numbers.find(parameter.name);
      return found == numbers.end() ? std::vector<double>() : found->second;
    });
  };
  CHECK(std::get<Friction>(read("friction", {{"coefficient", {0.4}}})).coefficient == 0.4);
  CHECK(std::get<Gravity>(read("gravity", {{"acceleration", {1, 2, 3}}})).acceleration == supernormal::Vector3(1, 2, 3));
  const auto sleep = std::get<AutoDisable>(read("auto_disable", {{"linear", {0.5}}, {"samples", {7}}, {"time", {3}}}));
  CHECK(sleep.linear == 0.5);
  CHECK(sleep.angular == AutoDisable().angular);
  CHECK(sleep.samples == 7);
  CHECK(sleep.time == 3);
  CHECK_THROWS_WITH_AS(read("auto_disable", {{"samples", {2.5}}}), "samples = 2.5, but must be a whole number",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(read("gravity", {{"acceleration", {1, 2}}}), doctest::Contains("acceleration has 2 numbers; allowed: 3"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(read("fricton", {}), "no effect has the name fricton", std::invalid_argument);
  // What may be left out, and every other parameter, is in the words of the description.
  for (const Description& description : descriptions()) {
    read_effect(description.name, [&](const Parameter& parameter) {
      CHECK_MESSAGE(std::string(description.parameters).find(parameter.name) != std::string::npos, description.name);
      return std::vector<double>();
    });
  }
}
