// Leaks: grains that have left the container.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "model/scene.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// The space in which grains have not leaked, with the walls where they are at the moment: the container and the sinks (is_inside).
/// It ends at planes that are parts. In an open container under gravity it ends below the lowest wall or sink, since nothing there
/// stops a fall.
class Inside {
 public:
  explicit Inside(const World& world);

  /// `position`: m, of the middle of a body; `reach`: m, of the body from there against gravity.
  bool contains(const Point& position, double reach) const;
  /// m, of a bounded wall from its middle, along gravity.
  double reach_of(dGeomID wall) const;

 private:
  double bottom_of(const World& world) const;

  const Scene& scene_;
  std::vector<std::array<dReal, 4>> planes_;  // normal and offset (m) of parts
  Vector3 down_ = Vector3::Zero();            // unit; zero without gravity
  double bottom_ = 0;                         // m along down_, where the space ends; infinite if it does not
};

/// A grain that has left the container: through a wall, the floor or the ground, over a hopper's rim, or past all parts of an open
/// container. A grain in a sink has not left.
struct Leak {
  double time;                       ///< s, after the first step that left it outside
  std::size_t grain;                 ///< index in World::grains()
  std::string kind;                  ///< kind
  Point position;                    ///< m
  std::array<double, 4> quaternion;  ///< w, x, y, z
  Point velocity;                    ///< m/s

  void serialize(auto& archive) { archive(time, grain, kind, position, quaternion, velocity); }
};

/// "grain 17 (soybean) left the container at t = 0.51 s: position …"
std::string describe(const Leak& leak);

/// A sentence for each free wall that is not Inside.
std::vector<std::string> free_walls_outside(const World& world);

/// Monitors all grains of a world in all steps.
class LeakWatch {
 public:
  explicit LeakWatch(const World& world);

  void after_step(double time);

  std::size_t count() const { return count_; }  ///< number of grains that have been outside at any time
  const std::optional<Leak>& first() const { return first_; }

  void serialize(auto& archive) { archive(has_leaked_, count_, first_); }

 private:
  const World& world_;
  std::vector<bool> has_leaked_;
  std::size_t count_ = 0;
  std::optional<Leak> first_;
};

}  // namespace falling_particles
