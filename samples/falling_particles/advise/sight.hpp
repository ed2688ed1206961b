// Ray casts in a scene before it runs.
#pragma once

#include <ode/ode.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "common/motion.hpp"
#include "world/world.hpp"

namespace falling_particles {

/// Casts rays against the walls and the sinks of a world, where they start.
class Sight {
 public:
  struct Seen {
    double distance = 0;              ///< m
    std::optional<std::size_t> wall;  ///< index into Scene::walls; empty for a wall that is no part, or a sink
    bool is_back = false;             ///< whether the ray hits the back of a single-sided triangle
  };

  /// The world must outlive this object.
  explicit Sight(const World& world);

  /// The first hit of a ray; empty if there is none. `direction` must have unit length.
  std::optional<Seen> look(const Point& from, const Vector3& direction) const;

 private:
  using Geom = std::unique_ptr<dxGeom, decltype(&dGeomDestroy)>;

  std::optional<dContactGeom> hit_of(dGeomID solid) const;
  bool is_back_of(const Wall& wall, int triangle, const Vector3& direction) const;

  const World& world_;
  std::vector<Geom> sinks_;
  std::vector<dGeomID> solids_;  // Scene::walls first
  Geom ray_;
};

}  // namespace falling_particles
