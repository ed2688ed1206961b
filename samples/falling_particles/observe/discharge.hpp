// The discharge of a hopper, and Beverloo's law for it.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bed.hpp"
#include "common/random.hpp"
#include "model/hopper.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// The steady section of the discharge, as fractions of the charge: after the start, and while the outlet is well covered.
constexpr double kSteadyFrom = 0.2;
constexpr double kSteadyTo = 0.6;

/// The charge of a hopper when its outlet opens.
struct Charge {
  double time;            ///< s
  double mass;            ///< kg, of all grains
  double grain_diameter;  ///< m, diameter of a sphere with the grains' mean volume
  Bed bed;

  void serialize(auto& archive) { archive(time, mass, grain_diameter, bed); }
};

/// Constants of Beverloo's law: the discharge coefficient, and the width of the empty annulus at the rim relative to the grain
/// diameter.
constexpr double kBeverlooC = 0.58;
constexpr double kBeverlooK = 1.4;

/// The mass flow (kg/s) through a round outlet in a flat bottom: C rho sqrt(g) (D - k d)^2.5; 0 if D is below k d. W. A. Beverloo,
/// H. A. Leniger, J. van de Velde, The flow of granular solids through orifices, Chem. Eng. Sci. 15 (1961) 260-269. `outlet` and
/// `grain_diameter` in m, `bulk_density` in kg/m^3, `gravity` in m/s^2.
double beverloo_mass_flow(double outlet, double grain_diameter, double bulk_density, double gravity);

/// Opens the outlet of a hopper at its time, and counts the grains whose centres pass it.
class Discharge {
 public:
  Discharge(World& world, const Hopper& hopper, Random& random);

  void after_step(double time);

  const std::optional<Charge>& charge() const { return charge_; }  ///< empty while the outlet is closed
  std::size_t count() const { return passages_.size(); }
  double mass() const { return passages_.empty() ? 0 : passages_.back().total_mass; }    ///< kg
  double last_passage() const { return passages_.empty() ? 0 : passages_.back().time; }  ///< s

  /// kg/s, the mean over the steady section; empty if less was discharged.
  std::optional<double> mass_flow() const;

  void serialize(auto& archive) { archive(charge_, has_passed_, passages_); }

 private:
  struct Passage {
    double time;
    double total_mass;  // kg, up to and including this grain
    void serialize(auto& archive) { archive(time, total_mass); }
  };
  void open(double time);
  const Passage* find_passage(double share) const;

  World& world_;
  const Hopper& hopper_;
  Random& random_;
  std::optional<Charge> charge_;
  std::vector<bool> has_passed_;
  std::vector<Passage> passages_;
};

}  // namespace falling_particles
