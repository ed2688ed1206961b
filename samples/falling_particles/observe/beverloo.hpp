// Beverloo's law for the flow of grains through an outlet.
#pragma once

namespace falling_particles {

/// Constants of Beverloo's law: discharge coefficient, and width of the rim's empty annulus relative to the grain.
constexpr double kBeverlooC = 0.58;
constexpr double kBeverlooK = 1.4;

/// Mass flow, kg/s, through a round outlet in a flat bottom: C rho sqrt(g) (D - k d)^2.5; 0 when the outlet is below k d.
/// W. A. Beverloo, H. A. Leniger, J. van de Velde, The flow of granular solids through orifices, Chem. Eng. Sci. 15 (1961) 260-269.
/// `outlet` and `grain_diameter` in m, `bulk_density` in kg/m^3, `gravity` in m/s^2.
double beverloo_mass_flow(double outlet, double grain_diameter, double bulk_density, double gravity);

}  // namespace falling_particles
