// Energies of grains.
#pragma once

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

struct Energy {
  double kinetic;    ///< J, of translation and rotation
  double potential;  ///< J, in the scene's gravity, 0 at the origin, and elastic, of bonds
  double total() const { return kinetic + potential; }
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(kinetic, potential);
  }
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

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(start_, least_, gained_);
  }

 private:
  const World& world_;
  const Scene& scene_;
  double start_;
  double least_;
  double gained_ = 0;
};

}  // namespace falling_particles
