// Leaks: grains that have left the container.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// A grain whose centre has left the container: through a wall, the floor or the ground, or over a hopper's rim. A grain in a sink
/// has not left.
struct Leak {
  double time;                       ///< s, after the first step that left it outside
  std::size_t grain;                 ///< index in World::grains()
  std::string kind;                  ///< kind
  Point position;                    ///< m
  std::array<double, 4> quaternion;  ///< w, x, y, z
  Point velocity;                    ///< m/s

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(time, grain, kind, position, quaternion, velocity);
  }
};

/// "grain 17 (soybean) left the container at t = 0.51 s: position …"
std::string describe(const Leak& leak);

/// Monitors all grains of a world in all steps.
class LeakWatch {
 public:
  LeakWatch(const World& world, const Scene& scene);

  void after_step(double time);

  std::size_t count() const { return count_; }  ///< number of grains that have been outside at any time
  const std::optional<Leak>& first() const { return first_; }

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(has_leaked_, count_, first_);
  }

 private:
  const World& world_;
  const Scene& scene_;
  std::vector<bool> has_leaked_;
  std::size_t count_ = 0;
  std::optional<Leak> first_;
};

}  // namespace falling_particles
