#include "effects/validate.hpp"

#include <stdexcept>
#include <string>

#include "shapes/validation.hpp"

namespace supernormal::effects {
namespace {

class Check {
 public:
  explicit Check(const Effect& effect) : name_(descriptions()[effect.index()].name) {}

  void closed(const char* parameter, double value, double low, double high, const char* unit = "") const {
    try {
      require_in(full(parameter).c_str(), value, low, high, unit);
    } catch (const std::invalid_argument& error) {
      throw BadEffect(name_, parameter, error.what());
    }
  }
  void above_zero(const char* parameter, double value, double high, const char* unit = "") const {
    if (value > 0 && value <= high) return;
    const std::string tail = std::string(*unit == '\0' ? "" : " ") + unit;
    throw BadEffect(name_, parameter,
                    full(parameter) + " = " + to_text(value) + tail + " is outside (0, " + to_text(high) + "]" + tail);
  }
  void not_both_zero(const char* first, double value1, const char* second, double value2) const {
    if (value1 > 0 || value2 > 0) return;
    throw BadEffect(name_, first, full(first) + " and " + second + " are both 0; one must be above 0, or the effect left out");
  }
  void materials(const MaterialSelector& on) const {
    if (!on.is_all()) closed("material", on.first(), 0, kLastMaterial);
    if (on.is_pair()) closed("material", on.second(), 0, kLastMaterial);
  }

  void operator()(const Friction& e) const { above_zero("coefficient", e.coefficient, 100); }
  void operator()(const AnisotropicFriction& e) const {
    closed("along", e.along, 0, 100);
    closed("across", e.across, 0, 100);
    not_both_zero("along", e.along, "across", e.across);
    if (e.direction.allFinite() && e.direction.norm() > 0) return;
    throw BadEffect(name_, "direction",
                    full("direction") + " = (" + to_text(e.direction.x()) + ", " + to_text(e.direction.y()) + ", " +
                        to_text(e.direction.z()) + ") is no direction; it must be finite and not 0");
  }
  void operator()(const RollingResistance& e) const {
    closed("rolling", e.rolling, 0, 1e3, "m");
    closed("spinning", e.spinning, 0, 1e3, "m");
    not_both_zero("rolling", e.rolling, "spinning", e.spinning);
  }
  void operator()(const Restitution& e) const {
    above_zero("coefficient", e.coefficient, 1);
    closed("threshold", e.threshold, 0, 100, "m/s");
  }
  void operator()(const Compliance& e) const {
    above_zero("stiffness", e.stiffness, 1e15, "N/m");
    closed("damping", e.damping, 0, 1e15, "N s/m");
  }
  void operator()(const Hertz& e) const {
    above_zero("youngs_modulus", e.youngs_modulus, 1e15, "Pa");
    closed("poisson_ratio", e.poisson_ratio, 0, 0.5);
    closed("restitution", e.restitution, 0.05, 1);
  }
  void operator()(const Adhesion& e) const { above_zero("pull_off", e.pull_off, 1e9, "N"); }
  void operator()(const Gravity& e) const {
    for (const double component : e.acceleration) closed("acceleration", component, -1e4, 1e4, "m/s^2");
  }
  void operator()(const QuadraticDrag& e) const {
    above_zero("density", e.density, 1e5, "kg/m^3");
    above_zero("coefficient", e.coefficient, 100);
  }
  void operator()(const StokesDrag& e) const { above_zero("viscosity", e.viscosity, 1e6, "Pa s"); }
  void operator()(const Buoyancy& e) const {
    above_zero("density", e.density, 1e5, "kg/m^3");
    closed("level", e.level, -1e6, 1e6, "m");
  }
  void operator()(const Damping& e) const {
    closed("linear", e.linear, 0, 1e6, "1/s");
    closed("angular", e.angular, 0, 1e6, "1/s");
    not_both_zero("linear", e.linear, "angular", e.angular);
  }
  void operator()(const AutoDisable& e) const {
    above_zero("linear", e.linear, 1e3, "m/s");
    above_zero("angular", e.angular, 1e6, "rad/s");
    closed("time", e.time, 0, 1e6, "s");
    closed("samples", e.samples, 1, 1000);
  }
  void operator()(const MaxCorrectingVelocity& e) const { above_zero("velocity", e.velocity, 1e6, "m/s"); }
  void operator()(const SurfaceLayer& e) const { above_zero("depth", e.depth, 1e3, "m"); }
  void operator()(const SpeculativeContacts& /*effect*/) const {}

  const char* name() const { return name_; }

 private:
  std::string full(const char* parameter) const { return std::string(name_) + ": " + parameter; }
  const char* name_;
};

/// The materials that the effect applies to; null for an effect that is not about contacts.
const MaterialSelector* surfaces_of(const Effect& effect) {
  return std::visit(
      [](const auto& e) -> const MaterialSelector* {
        if constexpr (requires { e.on; }) {
          return &e.on;
        } else {
          return nullptr;
        }
      },
      effect);
}

bool is_same(const MaterialSelector& a, const MaterialSelector& b) {
  return a == b || (a.is_pair() && b.is_pair() && a.first() == b.second() && a.second() == b.first());
}

void require_listed_once(const std::vector<Effect>& list, const Effect& effect) {
  const MaterialSelector* const on = surfaces_of(effect);
  for (const Effect& other : list) {
    if (&other == &effect || other.index() != effect.index()) continue;
    if (on == nullptr || is_same(*on, *surfaces_of(other))) {
      throw BadEffect(Check(effect).name(), "",
                      std::string(Check(effect).name()) + " is listed twice" + (on == nullptr ? "" : " for the same surfaces") +
                          "; it must be listed once");
    }
  }
}

template <typename Wanted>
bool has(const std::vector<Effect>& list) {
  for (const Effect& effect : list) {
    if (std::holds_alternative<Wanted>(effect)) return true;
  }
  return false;
}

void require_company(const std::vector<Effect>& list) {
  if (has<Buoyancy>(list) && !has<Gravity>(list)) {
    throw BadEffect("buoyancy", "", "buoyancy is listed without gravity, which it is the reaction to: list both or none");
  }
  if (has<MaxCorrectingVelocity>(list) && (has<Compliance>(list) || has<Hertz>(list))) {
    throw BadEffect("max_correcting_velocity", "",
                    "max_correcting_velocity is listed with compliance or hertz, whose forces it would cut: list one of them");
  }
}

}  // namespace

void require_valid(const std::vector<Effect>& list) {
  for (const Effect& effect : list) {
    const Check check(effect);
    if (const MaterialSelector* const on = surfaces_of(effect)) check.materials(*on);
    std::visit(check, effect);
    require_listed_once(list, effect);
  }
  require_company(list);
}

}  // namespace supernormal::effects
