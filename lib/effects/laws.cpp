#include "effects/laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/validation.hpp"

namespace supernormal::effects {
namespace {

/// Where a parameter may lie.
struct Range {
  double low, high;
  const char* unit = "";
  bool is_open = false;      ///< whether `low` itself is outside
  bool has_default = false;  ///< whether a scene may leave the parameter out
};

constexpr Range above_zero(double high, const char* unit = "") { return {0, high, unit, true}; }
constexpr Range closed(double low, double high, const char* unit = "") { return {low, high, unit}; }
constexpr Range optional(Range range) {
  range.has_default = true;
  return range;
}

constexpr const char* kNoPass = "none; ODE does it";
constexpr const char* kPerContact = "one per contact";
constexpr const char* kPerBody = "one per body";

/// The law of an effect: its name, the rows that it adds to a contact, the work of a step, its source, and its parameters with
/// their ranges, which `list` shows to a visitor. An effect without a law must not compile.
template <typename E>
struct Law;

template <>
struct Law<Friction> {
  static constexpr Description kText = {"friction", "", 2, kPerContact,
                                        "Coulomb; cone kept by an inscribed square turned to the slip"};
  static void list(auto& e, auto& visitor) { visitor.number("coefficient", e.coefficient, above_zero(100)); }
};

template <>
struct Law<AnisotropicFriction> {
  static constexpr Description kText = {"anisotropic_friction", "", 2, kPerContact,
                                        "Goyal, Ruina and Papadopoulos, Wear 143 (1991)"};
  static void list(auto& e, auto& visitor) {
    visitor.number("along", e.along, closed(0, 100));
    visitor.number("across", e.across, closed(0, 100));
    visitor.not_both_zero("along", e.along, "across", e.across);
    visitor.direction("direction", e.direction, "of the body");
  }
};

template <>
struct Law<RollingResistance> {
  static constexpr Description kText = {"rolling_resistance", "", 3, kPerContact,
                                        "Ai et al., Powder Technology 206 (2011), model A"};
  static void list(auto& e, auto& visitor) {
    visitor.number("rolling", e.rolling, optional(closed(0, 1e3, "m")));
    visitor.number("spinning", e.spinning, optional(closed(0, 1e3, "m")));
    visitor.not_both_zero("rolling", e.rolling, "spinning", e.spinning);
  }
};

template <>
struct Law<Restitution> {
  static constexpr Description kText = {"restitution", "", 0, kNoPass, "Newton"};
  static void list(auto& e, auto& visitor) {
    visitor.number("coefficient", e.coefficient, above_zero(1));
    visitor.number("threshold", e.threshold, optional(closed(0, 100, "m/s")));
  }
};

template <>
struct Law<Compliance> {
  static constexpr Description kText = {"compliance", "", 0, kPerContact, "Kelvin and Voigt"};
  static void list(auto& e, auto& visitor) {
    visitor.number("stiffness", e.stiffness, above_zero(1e15, "N/m"));
    visitor.number("damping", e.damping, optional(closed(0, 1e15, "N s/m")));
  }
};

template <>
struct Law<Hertz> {
  static constexpr Description kText = {"hertz", "", 0, kPerContact,
                                        "Johnson, Contact Mechanics (1985), 4.2; Tsuji et al., Powder Technology 71 (1992)"};
  static void list(auto& e, auto& visitor) {
    visitor.number("youngs_modulus", e.youngs_modulus, above_zero(1e15, "Pa"));
    visitor.number("poisson_ratio", e.poisson_ratio, closed(0, 0.5));
    visitor.number("restitution", e.restitution, optional(closed(0.05, 1)));
  }
};

template <>
struct Law<Adhesion> {
  static constexpr Description kText = {"adhesion", "", 0, kPerContact,
                                        "constant attraction, as Derjaguin, Muller and Toporov (1975)"};
  static void list(auto& e, auto& visitor) { visitor.number("pull_off", e.pull_off, above_zero(1e9, "N")); }
};

template <>
struct Law<Gravity> {
  static constexpr Description kText = {"gravity", "", 0, kNoPass, "uniform field"};
  static void list(auto& e, auto& visitor) { visitor.vector("acceleration", e.acceleration, closed(-1e4, 1e4, "m/s^2")); }
};

template <>
struct Law<QuadraticDrag> {
  static constexpr Description kText = {"quadratic_drag", "", 0, kPerBody, "Newton; area of the body itself"};
  static void list(auto& e, auto& visitor) {
    visitor.number("density", e.density, above_zero(1e5, "kg/m^3"));
    visitor.number("coefficient", e.coefficient, above_zero(100));
  }
};

template <>
struct Law<StokesDrag> {
  static constexpr Description kText = {"stokes_drag", "", 0, kPerBody, "Leith, Aerosol Science and Technology 6 (1987)"};
  static void list(auto& e, auto& visitor) { visitor.number("viscosity", e.viscosity, above_zero(1e6, "Pa s")); }
};

template <>
struct Law<Buoyancy> {
  static constexpr Description kText = {"buoyancy", "", 0, kPerBody, "Archimedes"};
  static void list(auto& e, auto& visitor) {
    visitor.number("density", e.density, above_zero(1e5, "kg/m^3"));
    visitor.number("level", e.level, closed(-1e6, 1e6, "m"));
  }
};

template <>
struct Law<Damping> {
  static constexpr Description kText = {"damping", "", 0, kNoPass, "exponential decay"};
  static void list(auto& e, auto& visitor) {
    visitor.number("linear", e.linear, optional(closed(0, 1e6, "1/s")));
    visitor.number("angular", e.angular, optional(closed(0, 1e6, "1/s")));
    visitor.not_both_zero("linear", e.linear, "angular", e.angular);
  }
};

template <>
struct Law<AutoDisable> {
  static constexpr Description kText = {"auto_disable", "", 0, kNoPass, "ODE manual"};
  static void list(auto& e, auto& visitor) {
    visitor.number("linear", e.linear, above_zero(1e3, "m/s"));
    visitor.number("angular", e.angular, above_zero(1e6, "rad/s"));
    visitor.number("time", e.time, optional(closed(0, 1e6, "s")));
    visitor.whole("samples", e.samples, optional(closed(1, 1000)));
  }
};

template <>
struct Law<MaxCorrectingVelocity> {
  static constexpr Description kText = {"max_correcting_velocity", "", 0, kNoPass, "ODE manual"};
  static void list(auto& e, auto& visitor) { visitor.number("velocity", e.velocity, above_zero(1e6, "m/s")); }
};

template <>
struct Law<SurfaceLayer> {
  static constexpr Description kText = {"surface_layer", "", 0, kNoPass, "ODE manual"};
  static void list(auto& e, auto& visitor) { visitor.number("depth", e.depth, above_zero(1e3, "m")); }
};

template <>
struct Law<SpeculativeContacts> {
  static constexpr Description kText = {"speculative_contacts", "", 0, "one per contact ahead of touch",
                                        "Anitescu and Potra, Nonlinear Dynamics 14 (1997)"};
  static void list(auto& /*effect*/, auto& /*visitor*/) {}
};

/// Refuses what a law shows it.
class Check {
 public:
  explicit Check(const char* name) : name_(name) {}

  void number(const char* parameter, double value, const Range& range) const {
    if (range.is_open) {
      if (value > range.low && value <= range.high) return;
      const std::string tail = std::string(*range.unit == '\0' ? "" : " ") + range.unit;
      throw BadEffect(name_, parameter,
                      full(parameter) + " = " + to_text(value) + tail + " is outside (" + to_text(range.low) + ", " +
                          to_text(range.high) + "]" + tail);
    }
    try {
      require_in(full(parameter).c_str(), value, range.low, range.high, range.unit);
    } catch (const std::invalid_argument& error) {
      throw BadEffect(name_, parameter, error.what());
    }
  }
  void whole(const char* parameter, int value, const Range& range) const { number(parameter, value, range); }
  void vector(const char* parameter, const Vector3& value, const Range& range) const {
    for (const double component : value) number(parameter, component, range);
  }
  void direction(const char* parameter, const Vector3& value, const char* /*of*/) const {
    if (value.allFinite() && value.norm() > 0) return;
    throw BadEffect(name_, parameter,
                    full(parameter) + " = (" + to_text(value.x()) + ", " + to_text(value.y()) + ", " + to_text(value.z()) +
                        ") is no direction; it must be finite and not 0");
  }
  void not_both_zero(const char* first, double value1, const char* second, double value2) const {
    if (value1 > 0 || value2 > 0) return;
    throw BadEffect(name_, first, full(first) + " and " + second + " are both 0; one must be above 0, or the effect left out");
  }

 private:
  std::string full(const char* parameter) const { return std::string(name_) + ": " + parameter; }
  const char* name_;
};

/// Puts the parameters that a law shows it into words: "rolling, spinning [0, 1e3] m, 0 without it".
class Words {
 public:
  void number(const char* parameter, double value, const Range& range) {
    const std::string text = std::string(range.is_open ? " (" : " [") + short_text(range.low) + ", " + short_text(range.high) +
                             "]" + (*range.unit == '\0' ? "" : " ") + range.unit +
                             (range.has_default ? ", " + short_text(value) + " without it" : "");
    // Parameters with one range have it once.
    const bool has_same_range = text == range_;
    if (has_same_range) text_.resize(text_.size() - range_.size());
    text_ += (text_.empty() ? "" : has_same_range ? ", " : "; ") + std::string(parameter) + text;
    range_ = text;
  }
  void whole(const char* parameter, int value, const Range& range) { number(parameter, value, range); }
  void vector(const char* parameter, const Vector3& /*value*/, const Range& range) { number(parameter, 0, range); }
  void direction(const char* parameter, const Vector3& /*value*/, const char* of) {
    text_ += std::string("; ") + parameter + ", " + of;
    range_.clear();
  }
  static void not_both_zero(const char* /*first*/, double /*value1*/, const char* /*second*/, double /*value2*/) {}

  std::string text() const { return text_.empty() ? "none" : text_; }

 private:
  /// Powers of ten from 1000 on as 1e3.
  static std::string short_text(double value) {
    const double power = std::round(std::log10(std::abs(value)));
    if (!(std::abs(value) >= 1e3) || std::pow(10, power) != std::abs(value)) return to_text(value);
    return std::string(value < 0 ? "-" : "") + "1e" + std::to_string(std::lround(power));
  }

  std::string text_, range_;
};

/// Sets the parameters that a law shows it.
class Reader {
 public:
  using Read = std::function<std::vector<double>(const Parameter&)>;
  explicit Reader(const Read& read) : read_(read) {}

  void number(const char* name, double& value, const Range& range) const { set(name, Parameter::Kind::Number, range, &value, 1); }
  void whole(const char* name, int& value, const Range& range) const {
    double number = value;
    set(name, Parameter::Kind::Whole, range, &number, 1);
    if (std::nearbyint(number) != number || std::abs(number) > std::numeric_limits<int>::max()) {
      throw std::invalid_argument(std::string(name) + " = " + to_text(number) + ", but must be a whole number");
    }
    value = static_cast<int>(number);
  }
  void vector(const char* name, Vector3& value, const Range& range) const {
    set(name, Parameter::Kind::Vector, range, value.data(), 3);
  }
  void direction(const char* name, Vector3& value, const char* /*of*/) const { vector(name, value, {}); }
  static void not_both_zero(const char* /*first*/, double /*value1*/, const char* /*second*/, double /*value2*/) {}

 private:
  void set(const char* name, Parameter::Kind kind, const Range& range, double* values, std::size_t count) const {
    const std::vector<double> numbers = read_({name, kind, range.has_default});
    if (numbers.empty()) return;
    if (numbers.size() == count) {
      std::ranges::copy(numbers, values);
      return;
    }
    throw std::invalid_argument(std::string(name) + " has " + std::to_string(numbers.size()) +
                                " numbers; allowed: " + std::to_string(count) + ", or none for the default");
  }

  const Read& read_;
};

constexpr std::size_t kCount = std::variant_size_v<Effect::variant>;

/// The descriptions, with the texts of the parameters, to which they point.
struct Descriptions {
  template <std::size_t... kIs>
  explicit Descriptions(std::index_sequence<kIs...> /*indices*/) {
    (add<std::variant_alternative_t<kIs, Effect::variant>>(kIs), ...);
  }

  std::array<std::string, kCount> parameters;
  std::array<Description, kCount> all{};

 private:
  template <typename E>
  void add(std::size_t index) {
    Words words;
    const E by_default{};
    Law<E>::list(by_default, words);
    parameters[index] = words.text();
    all[index] = Law<E>::kText;
    all[index].parameters = parameters[index].c_str();
  }
};

template <typename E>
Effect read_one(const Reader& reader) {
  E effect;
  Law<E>::list(effect, reader);
  return effect;
}

template <std::size_t... kIs>
Effect read_at(std::size_t index, const Reader& reader, std::index_sequence<kIs...> /*indices*/) {
  using Make = Effect (*)(const Reader&);
  constexpr std::array<Make, kCount> kMakers = {read_one<std::variant_alternative_t<kIs, Effect::variant>>...};
  return kMakers[index](reader);
}

/// Throws BadEffect for the first parameter out of its range.
void require_parameters(const Effect& effect) {
  const auto check = [](const auto& e) {
    using E = std::remove_cvref_t<decltype(e)>;
    const Check visitor(Law<E>::kText.name);
    if constexpr (requires { e.on; }) {
      if (!e.on.is_all()) visitor.number("material", e.on.first(), closed(0, kLastMaterial));
      if (e.on.is_pair()) visitor.number("material", e.on.second(), closed(0, kLastMaterial));
    }
    Law<E>::list(e, visitor);
  };
  std::visit(check, effect);
}

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
      const std::string name = descriptions()[effect.index()].name;
      throw BadEffect(name, "",
                      name + " is listed twice" + (on == nullptr ? "" : " for the same surfaces") + "; it must be listed once");
    }
  }
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

std::span<const Description> descriptions() {
  static const Descriptions all{std::make_index_sequence<kCount>()};
  return all.all;
}

Effect read_effect(std::string_view name, const std::function<std::vector<double>(const Parameter&)>& read) {
  const auto all = descriptions();
  const auto found = std::ranges::find(all, name, &Description::name);
  if (found == all.end()) throw std::invalid_argument("no effect has the name " + std::string(name));
  return read_at(static_cast<std::size_t>(found - all.begin()), Reader(read), std::make_index_sequence<kCount>());
}

void require_valid(const std::vector<Effect>& list) {
  for (const Effect& effect : list) {
    require_parameters(effect);
    require_listed_once(list, effect);
  }
  require_company(list);
}

}  // namespace supernormal::effects
