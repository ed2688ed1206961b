// Energies, overlaps and sizes of grains.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

struct Energy {
  double kinetic;    ///< J, of translation and rotation
  double potential;  ///< J, in the scene's gravity, 0 at the origin, and elastic, of bonds
  double total() const { return kinetic + potential; }
  void serialize(auto& archive) { archive(kinetic, potential); }
};

Energy measure_energy(const World& world, const Scene& scene);

/// m, the height to which the kinetic energy would lift all grains together; 0 without gravity.
double kinetic_height(const World& world, const Scene& scene);

/// J, of the grain with the largest kinetic energy.
double largest_kinetic_energy(const World& world);

/// Monitors the total energy of all grains in all steps. Nothing in a scene without moving walls may increase it.
class EnergyWatch {
 public:
  EnergyWatch(const World& world, const Scene& scene);

  void after_step();
  /// Accounts for the energy (J) of grains that were inserted (above 0) or removed (below 0), which is neither a gain nor a loss.
  void exchange(double energy);

  double gained() const { return gained_; }        ///< J, the largest increase from the energy after an earlier step
  double lost() const { return start_ - least_; }  ///< J, from the start to the least energy

  void serialize(auto& archive) { archive(start_, least_, gained_); }

 private:
  const World& world_;
  const Scene& scene_;
  double start_;
  double least_;
  double gained_ = 0;
};

struct Overlap {
  double depth = 0;                   ///< m, of the deepest pair, walls included; 0 when nothing overlaps
  double relative_to_pair = 0;        ///< largest depth / smallest half-axis of the pair's grains
  std::size_t pairs = 0;              ///< number of pairs that overlap
  std::array<dGeomID, 2> worst = {};  ///< the pair of relative_to_pair; both null when nothing overlaps
  double worst_depth = 0;             ///< m, of this pair
};

/// Measures every pair whose bounding boxes meet, by snGeomProximity. Other pairs cannot overlap. The images of a periodic world
/// must be in place.
Overlap measure_overlap(const World& world);

/// The number of grains that are not Inside.
std::size_t count_outside(const World& world);

/// The sieve sizes (GrainKind::sieve_size) of all grains of one kind so far.
struct DrawnSizes {
  std::string kind;
  std::size_t number = 0;
  double mass = 0;                  ///< kg, of all
  double mean = 0;                  ///< m, by number
  double standard_deviation = 0;    ///< m, by number
  double smallest = 0;              ///< m
  double largest = 0;               ///< m
  double median = 0;                ///< m, by number
  std::array<double, 3> by_mass{};  ///< m: d10, d50 and d90, below which 10, 50 and 90 % of the mass are
};

/// The sizes of the kinds that have a distribution.
std::vector<DrawnSizes> measure_sizes(const World& world, const Scene& scene);

}  // namespace falling_particles
