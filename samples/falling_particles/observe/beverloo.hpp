// Beverloo's law for the flow of grains through an outlet.
#pragma once

namespace falling_particles {

/// Constants of Beverloo's law: the discharge coefficient, and the width of the empty annulus at the rim relative to the grain
/// diameter.
constexpr double kBeverlooC = 0.58;
constexpr double kBeverlooK = 1.4;

/// The mass flow (kg/s) through a round outlet in a flat bottom: C rho sqrt(g) (D - k d)^2.5; 0 if D is below k d. W. A. Beverloo,
/// H. A. Leniger, J. van de Velde, The flow of granular solids through orifices, Chem. Eng. Sci. 15 (1961) 260-269. `outlet` and
/// `grain_diameter` in m, `bulk_density` in kg/m^3, `gravity` in m/s^2.
double beverloo_mass_flow(double outlet, double grain_diameter, double bulk_density, double gravity);

}  // namespace falling_particles
