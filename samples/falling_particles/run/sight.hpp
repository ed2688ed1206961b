// What is seen from a place in a scene before it runs.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "model/motion.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// Looks along rays at the walls, parts and sinks of a world, where they start.
class Sight {
 public:
  struct Seen {
    double distance = 0;              ///< m
    std::optional<std::size_t> wall;  ///< its index; none for a wall or a sink
    bool is_back = false;             ///< whether it is a triangle that grains meet from its other side alone
  };

  /// The world must outlive this object.
  explicit Sight(const World& world);

  /// The first that a ray meets; empty where there is nothing. `direction` is of unit length.
  std::optional<Seen> look(const Point& from, const Vector3& direction) const;

 private:
  using Geom = std::unique_ptr<dxGeom, decltype(&dGeomDestroy)>;

  std::optional<dContactGeom> hit_of(dGeomID solid) const;
  bool is_back_of(const Wall& wall, int triangle, const Vector3& direction) const;

  const World& world_;
  std::vector<Geom> sinks_;
  std::vector<dGeomID> solids_;  // parts first
  Geom ray_;
};

}  // namespace falling_particles
