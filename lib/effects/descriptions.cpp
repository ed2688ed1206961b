#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "supernormal/effects.hpp"

namespace supernormal::effects {
namespace {

constexpr const char* kNoPass = "none; ODE does it";

/// An effect without a specialization must not compile.
template <typename E>
constexpr Description kDescription = E::has_no_description();

template <>
constexpr Description kDescription<Friction> = {"friction", "coefficient (0, 100]", 2, "one per contact",
                                                "Coulomb; cone kept by an inscribed square turned to the slip"};
template <>
constexpr Description kDescription<AnisotropicFriction> = {"anisotropic_friction", "along, across [0, 100]; direction, of the body",
                                                           2, "one per contact", "Goyal, Ruina and Papadopoulos, Wear 143 (1991)"};
template <>
constexpr Description kDescription<RollingResistance> = {"rolling_resistance", "rolling, spinning [0, 1e3] m", 3, "one per contact",
                                                         "Ai et al., Powder Technology 206 (2011), model A"};
template <>
constexpr Description kDescription<Restitution> = {"restitution", "coefficient (0, 1]; threshold [0, 100] m/s", 0,
                                                   "none; ODE does it", "Newton"};
template <>
constexpr Description kDescription<Compliance> = {"compliance", "stiffness (0, 1e15] N/m; damping [0, 1e15] N s/m", 0,
                                                  "one per contact", "Kelvin and Voigt"};
template <>
constexpr Description kDescription<Hertz> = {"hertz", "youngs_modulus (0, 1e15] Pa; poisson_ratio [0, 0.5]; restitution [0.05, 1]",
                                             0, "one per contact",
                                             "Johnson, Contact Mechanics (1985), 4.2; Tsuji et al., Powder Technology 71 (1992)"};
template <>
constexpr Description kDescription<Adhesion> = {"adhesion", "pull_off (0, 1e9] N", 0, "one per contact",
                                                "constant attraction, as Derjaguin, Muller and Toporov (1975)"};
template <>
constexpr Description kDescription<Gravity> = {"gravity", "acceleration [-1e4, 1e4] m/s^2", 0, kNoPass, "uniform field"};
template <>
constexpr Description kDescription<QuadraticDrag> = {"quadratic_drag", "density (0, 1e5] kg/m^3; coefficient (0, 100]", 0,
                                                     "one per body", "Newton; area of the body itself"};
template <>
constexpr Description kDescription<StokesDrag> = {"stokes_drag", "viscosity (0, 1e6] Pa s", 0, "one per body",
                                                  "Leith, Aerosol Science and Technology 6 (1987)"};
template <>
constexpr Description kDescription<Buoyancy> = {"buoyancy", "density (0, 1e5] kg/m^3; level [-1e6, 1e6] m", 0, "one per body",
                                                "Archimedes"};
template <>
constexpr Description kDescription<Damping> = {"damping", "linear, angular [0, 1e6] 1/s", 0, kNoPass, "exponential decay"};
template <>
constexpr Description kDescription<AutoDisable> = {
    "auto_disable", "linear (0, 1e3] m/s; angular (0, 1e6] rad/s; time [0, 1e6] s; samples [1, 1000]", 0, kNoPass, "ODE manual"};
template <>
constexpr Description kDescription<MaxCorrectingVelocity> = {"max_correcting_velocity", "velocity (0, 1e6] m/s", 0, kNoPass,
                                                             "ODE manual"};
template <>
constexpr Description kDescription<SurfaceLayer> = {"surface_layer", "depth (0, 1e3] m", 0, kNoPass, "ODE manual"};
template <>
constexpr Description kDescription<SpeculativeContacts> = {"speculative_contacts", "none", 0, "one per contact ahead of touch",
                                                           "Anitescu and Potra, Nonlinear Dynamics 14 (1997)"};

template <std::size_t... Indices>
constexpr auto all(std::index_sequence<Indices...> /*indices*/) {
  return std::array{kDescription<std::variant_alternative_t<Indices, Effect>>...};
}

constexpr auto kDescriptions = all(std::make_index_sequence<std::variant_size_v<Effect>>());

constexpr bool has_text(const char* text) { return text != nullptr && !std::string_view(text).empty(); }

constexpr bool are_complete() {
  for (const Description& each : kDescriptions) {
    if (!has_text(each.name) || !has_text(each.parameters) || !has_text(each.passes) || !has_text(each.source)) return false;
  }
  return true;
}
static_assert(are_complete(), "a description of an effect leaves out a text");

}  // namespace

std::span<const Description> descriptions() { return kDescriptions; }

}  // namespace supernormal::effects
