// The insertion and removal of grains during a run.
#pragma once

#include <deque>
#include <vector>

#include "feeding.hpp"
#include "model/scene.hpp"
#include "world.hpp"

namespace falling_particles {

/// Runs feeders and sinks between the steps, and counts their grains.
class Population {
 public:
  /// Both must outlive this object. The world must hold exactly the grains of the start.
  Population(World& world, const Scene& scene);

  /// Removes the grains that are in sinks after the last step, the scene's first sink first. Then inserts the grains that are due
  /// until `end` (s), when the next step ends. Returns the energy (J) of the inserted grains minus the energy of the removed ones.
  double before_step(double end);

  const std::deque<Feeding>& feeders() const { return feeders_; }
  /// The amounts that a sink has removed so far, by Scene::kinds.
  const std::vector<Amount>& taken(std::size_t sink) const { return taken_[sink]; }
  const Amount& at_start() const { return at_start_; }
  Amount fed() const;
  Amount taken() const;
  Amount present() const;

  /// Saves or restores the states of the feeders and the amounts, for an object of the same scene.
  template <typename Archive>
  void serialize(Archive& archive) {
    for (Feeding& feeding : feeders_) archive(feeding);
    archive(taken_, at_start_);
  }

 private:
  double take();
  double feed(double end);

  World& world_;
  const Scene& scene_;
  std::deque<Feeding> feeders_;
  std::vector<std::vector<Amount>> taken_;
  Amount at_start_;
};

}  // namespace falling_particles
