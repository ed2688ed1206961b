// Energies of grains.
#pragma once

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

struct Energy {
  double kinetic;    ///< J, of translation and rotation
  double potential;  ///< J, in the scene's gravity, 0 at the origin
  double total() const { return kinetic + potential; }
  template <typename Archive>
  void serialize(Archive& archive) {
    archive(kinetic, potential);
  }
};

Energy measure_energy(const World& world, const Scene& scene);

/// The height, m, to which the kinetic energy would lift all grains together; 0 without gravity.
double kinetic_height(const World& world, const Scene& scene);

/// J, of the grain that has most.
double largest_kinetic_energy(const World& world);

/// Watches the energy of all grains together in all steps: nothing in a scene may add to it.
class EnergyWatch {
 public:
  EnergyWatch(const World& world, const Scene& scene);

  void after_step();
  /// Grains have come with that energy (J), or gone with it (below 0): that is neither gain nor loss.
  void exchange(double energy);

  double gained() const { return gained_; }        ///< J, the largest rise over any step before
  double lost() const { return start_ - least_; }  ///< J, from the start to the least

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
