// The grains of a world that come and go.
#pragma once

#include <deque>
#include <vector>

#include "feeding.hpp"
#include "model/scene.hpp"
#include "world.hpp"

namespace falling_particles {

/// Lets feeders and sinks do their work between the steps, and keeps account of it.
class Population {
 public:
  /// Both must outlive this object. The world holds the grains of the start.
  Population(World& world, const Scene& scene);

  /// Takes away the grains that are in sinks after the last step, the first sink of the scene first; then feeds what is due until
  /// `end` (s), when the next step ends. Returns the energy (J) of the grains that have come, less that of those that have gone.
  double before_step(double end);

  const std::deque<Feeding>& feeders() const { return feeders_; }
  /// What a sink has taken so far, by Scene::kinds.
  const std::vector<Amount>& taken(std::size_t sink) const { return taken_[sink]; }
  const Amount& at_start() const { return at_start_; }
  Amount fed() const;
  Amount taken() const;
  Amount present() const;

  /// What the feeders remember, and the account, into an object of the same scene.
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
