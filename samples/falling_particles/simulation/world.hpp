// The ODE world of a scene.
#pragma once

#include <ode/ode.h>

#include <array>
#include <memory>
#include <optional>
#include <supernormal/effects.hpp>
#include <vector>

#include "container/walls.hpp"
#include "parts/part_bodies.hpp"
#include "periodic_cell.hpp"
#include "placement.hpp"
#include "scene/material.hpp"
#include "scene/scene.hpp"
#include "sweep_space.hpp"

namespace falling_particles {

struct Body {
  dBodyID body;
  dGeomID geom;  ///< of a compound the first one; geoms() gives all
  const Grain* grain;
  dMass mass;
  double scale = 1;  ///< of the grain's lengths

  std::vector<dGeomID> geoms() const;
  /// m; around all geoms: least and most x, y, z in turn.
  std::array<dReal, 6> aabb() const;
  double smallest_half_axis() const { return scale * grain->smallest_half_axis(); }  ///< m
  double bounding_radius() const { return scale * grain->bounding_radius(); }        ///< m
  double volume() const { return mass.mass / grain->density; }                       ///< m^3
  Point position() const {                                                           ///< m, of the centre
    const dReal* p = dBodyGetPosition(body);
    return {p[0], p[1], p[2]};
  }
  std::array<double, 4> quaternion() const {  ///< w, x, y, z
    const dReal* q = dBodyGetQuaternion(body);
    return {q[0], q[1], q[2], q[3]};
  }
};

/// The body of a geom in a World; null for a wall.
inline const Body* body_of(dGeomID geom) { return static_cast<const Body*>(dGeomGetData(geom)); }

inline supernormal::effects::Material material_of(dGeomID geom) {
  return body_of(geom) != nullptr ? kGrainMaterial : kWallMaterial;
}

/// A body of a grain as a geom of ours, its lengths times `scale`. Throws std::runtime_error when the library refuses it.
dGeomID create_geom(dSpaceID space, const GrainBody& body, double scale = 1);

/// Gives `body` the geoms of a grain whose lengths are times `scale`, each in its place, with `data`; returns the first one. Throws
/// std::runtime_error when the library refuses one.
dGeomID attach_geoms(dSpaceID space, const Grain& grain, double scale, dBodyID body, void* data);

/// The ODE world of a scene, which must outlive it.
class World {
 public:
  /// Throws std::runtime_error when the library refuses a body.
  World(const Scene& scene, const std::vector<Placement>& placements);
  World(const Scene&& scene, const std::vector<Placement>& placements) = delete;  // the scene would be gone at once
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  dWorldID id() const { return world_; }
  /// The space of the grains and of their images; the walls are not in it.
  SweepSpace& sweep() const { return *sweep_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  /// The effects that the scene names, compiled.
  supernormal::effects::Effects& effects() const { return *effects_; }
  const Walls& walls() const { return *walls_; }
  /// Calls back for every pair of a grain and a wall whose bounding boxes meet.
  void name_wall_pairs(void* data, dNearCallback* callback) const;
  /// Calls back for every pair of grains, or of a grain and a wall, whose bounding boxes meet.
  void name_pairs(void* data, dNearCallback* callback) const;
  PeriodicCell* cell() const { return cell_.get(); }  ///< for a periodic container, otherwise null
  PartBodies* parts() const { return parts_.get(); }  ///< null for a scene without parts

  /// Takes the lid off a hopper's outlet; call it once.
  void open_outlet() { walls_->open_outlet(); }

 private:
  void set_parameters(const Scene& scene);
  void add_body(const Grain& grain, const Placement& placement);
  static dMass mass_of(const Body& body);

  dWorldID world_;
  std::unique_ptr<SweepSpace> sweep_;
  std::unique_ptr<supernormal::effects::Effects> effects_;
  std::vector<Body> bodies_;
  std::optional<Walls> walls_;
  std::unique_ptr<PeriodicCell> cell_;
  std::unique_ptr<PartBodies> parts_;
};

}  // namespace falling_particles
