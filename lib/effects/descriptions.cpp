#include <array>

#include "supernormal/effects.hpp"

namespace supernormal::effects {
namespace {

constexpr const char* kNoPass = "none; ODE does it";

constexpr std::array<Description, std::variant_size_v<Effect>> kDescriptions = {{
    {"friction", "coefficient (0, 100]", 2, "one per contact", "Coulomb; cone kept by an inscribed square turned to the slip"},
    {"anisotropic_friction", "along, across [0, 100]; direction, of the body", 2, "one per contact",
     "Goyal, Ruina and Papadopoulos, Wear 143 (1991)"},
    {"rolling_resistance", "rolling, spinning [0, 1e3] m", 3, "one per contact",
     "Ai et al., Powder Technology 206 (2011), model A"},
    {"restitution", "coefficient (0, 1]; threshold [0, 100] m/s", 0, "none; ODE does it", "Newton"},
    {"compliance", "stiffness (0, 1e15] N/m; damping [0, 1e15] N s/m", 0, "one per contact", "Kelvin and Voigt"},
    {"hertz", "youngs_modulus (0, 1e15] Pa; poisson_ratio [0, 0.5]; restitution [0.05, 1]", 0, "one per contact",
     "Johnson, Contact Mechanics (1985), 4.2; Tsuji et al., Powder Technology 71 (1992)"},
    {"adhesion", "pull_off (0, 1e9] N", 0, "one per contact", "constant attraction, as Derjaguin, Muller and Toporov (1975)"},
    {"gravity", "acceleration [-1e4, 1e4] m/s^2", 0, kNoPass, "uniform field"},
    {"quadratic_drag", "density (0, 1e5] kg/m^3; coefficient (0, 100]", 0, "one per body", "Newton; area of the body itself"},
    {"stokes_drag", "viscosity (0, 1e6] Pa s", 0, "one per body", "Leith, Aerosol Science and Technology 6 (1987)"},
    {"buoyancy", "density (0, 1e5] kg/m^3; level [-1e6, 1e6] m", 0, "one per body", "Archimedes"},
    {"damping", "linear, angular [0, 1e6] 1/s", 0, kNoPass, "exponential decay"},
    {"auto_disable", "linear (0, 1e3] m/s; angular (0, 1e6] rad/s; time [0, 1e6] s; samples [1, 1000]", 0, kNoPass, "ODE manual"},
    {"max_correcting_velocity", "velocity (0, 1e6] m/s", 0, kNoPass, "ODE manual"},
    {"surface_layer", "depth (0, 1e3] m", 0, kNoPass, "ODE manual"},
}};

}  // namespace

std::span<const Description> descriptions() { return kDescriptions; }

}  // namespace supernormal::effects
