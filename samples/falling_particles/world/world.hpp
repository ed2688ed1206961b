// The ODE world of a scene.
#pragma once

#include <ode/ode.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <supernormal/effects.hpp>
#include <vector>

#include "container_geoms.hpp"
#include "model/material.hpp"
#include "model/scene.hpp"
#include "periodic_cell.hpp"
#include "placement.hpp"
#include "query_defaults.hpp"
#include "sweep_space.hpp"
#include "wall_bodies.hpp"
#include "world_state.hpp"

namespace falling_particles {

/// A grain of a world. Its index in the world's list is its own for good: that of a grain that is gone is not used again.
struct Grain {
  dBodyID body;  ///< null for a grain that is gone, of which kind, scale and mass.mass are left
  dGeomID geom;  ///< of a compound the first one; geoms() gives all
  const GrainKind* kind;
  dMass mass;
  double scale = 1;  ///< of the grain's lengths

  bool is_present() const { return body != nullptr; }
  std::vector<dGeomID> geoms() const;
  /// m; around all geoms: least and most x, y, z in turn.
  std::array<dReal, 6> aabb() const;
  double smallest_half_axis() const { return scale * kind->smallest_half_axis(); }  ///< m
  double bounding_radius() const { return scale * kind->bounding_radius(); }        ///< m
  double volume() const { return mass.mass / kind->density; }                       ///< m^3
  Point position() const {                                                          ///< m, of the centre
    const dReal* p = dBodyGetPosition(body);
    return {p[0], p[1], p[2]};
  }
  std::array<double, 4> quaternion() const {  ///< w, x, y, z
    const dReal* q = dBodyGetQuaternion(body);
    return {q[0], q[1], q[2], q[3]};
  }
};

/// Those of a list of bodies that are there, in its order. A grain that is gone costs nothing.
class PresentGrains {
 public:
  class Iterator {
   public:
    Iterator(const Grain* grains, const std::size_t* index) : grains_(grains), index_(index) {}
    const Grain& operator*() const { return grains_[*index_]; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return index_ == other.index_; }

   private:
    const Grain* grains_;
    const std::size_t* index_;
  };

  PresentGrains(const Grain* grains, std::span<const std::size_t> indices) : grains_(grains), indices_(indices) {}
  Iterator begin() const { return {grains_, indices_.data()}; }
  Iterator end() const { return {grains_, indices_.data() + indices_.size()}; }
  std::size_t size() const { return indices_.size(); }

 private:
  const Grain* grains_;
  std::span<const std::size_t> indices_;
};

/// The body of a geom in a World; null for a wall, of which a mesh may have data of its own.
inline const Grain* grain_of(dGeomID geom) {
  return dGeomGetClass(geom) == dTriMeshClass ? nullptr : static_cast<const Grain*>(dGeomGetData(geom));
}

inline supernormal::effects::Material material_of(dGeomID geom) {
  return grain_of(geom) != nullptr ? kGrainMaterial : kWallMaterial;
}

/// A body of a grain as a geom of ours, its lengths times `scale`. Throws std::runtime_error when the library refuses it.
dGeomID create_geom(dSpaceID space, const ConvexBody& body, double scale = 1);

/// Gives `body` the geoms of a grain whose lengths are times `scale`, each in its place, with `data`; returns the first one. Throws
/// std::runtime_error when the library refuses one.
dGeomID attach_geoms(dSpaceID space, const GrainKind& kind, double scale, dBodyID body, void* data);

/// Moves and turns a body to where a grain is to be.
void put(dBodyID body, const Placement& place);

/// The mass of a grain that has its geoms, about its centre. Throws std::runtime_error when the library refuses it.
dMass mass_of(const Grain& grain);

/// The ODE world of a scene, which must outlive it.
class World {
 public:
  /// Throws std::runtime_error when the library refuses a body.
  World(const Scene& scene, const std::vector<Placement>& placements);
  /// Goes on from a state of the same scene.
  struct GoOn {};
  World(const Scene& scene, GoOn how, const WorldState& state);
  World(const Scene&& scene, const std::vector<Placement>& placements) = delete;  // the scene would be gone at once
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  dWorldID id() const { return world_; }
  const Scene& scene() const { return scene_; }
  /// The space of the grains and of their images; the walls are not in it.
  SweepSpace& sweep() const { return *sweep_; }
  /// All that there have been so far, those that are gone included.
  const std::vector<Grain>& grains() const { return grains_; }
  /// Those of grains() that are there.
  PresentGrains present() const { return {grains_.data(), present_}; }
  /// Calls visit(geom) for the geoms of all grains that are there, and of their images in a periodic world.
  template <typename Visit>
  void for_each_grain_geom(const Visit& visit) const {
    if (cell_ == nullptr) {
      for (const Grain& grain : present()) {
        for (const dGeomID geom : grain.geoms()) visit(geom);
      }
    } else {
      sweep_->for_each_geom([&visit](dGeomID geom) {
        if (dGeomIsEnabled(geom) != 0) visit(geom);
      });
    }
  }
  /// m, the centre of a grain; in a periodic world the one within the cell.
  Point place_of(const Grain& grain) const { return cell_ == nullptr ? grain.position() : cell_->wrapped(grain.position()); }
  std::size_t index_of(const Grain& grain) const { return static_cast<std::size_t>(&grain - grains_.data()); }
  /// The effects that the scene names, compiled.
  supernormal::effects::Effects& effects() const { return *effects_; }
  const ContainerGeoms& container_geoms() const { return *container_geoms_; }
  /// Calls back for every pair of a grain and a wall whose bounding boxes meet.
  void name_wall_pairs(void* data, dNearCallback* callback) const;
  /// Calls back for every pair of grains, or of a grain and a wall, whose bounding boxes meet.
  void name_pairs(void* data, dNearCallback* callback) const;
  PeriodicCell* cell() const { return cell_.get(); }  ///< for a scene that repeats along any axis, otherwise null
  WallBodies* walls() const { return walls_.get(); }  ///< null for a scene without parts

  /// Puts a grain of a feeder's kind into the world and returns its index, that after the last one. Not during a step.
  std::size_t insert(const Placement& placement, const Point& velocity);
  /// Takes a grain out of the world. Not during a step, of whose contacts those of the grain are no longer valid.
  void remove(std::size_t index);

  /// What the next step follows from. Not all: the order in which ODE holds bodies, geoms and joints, what it knows of the speeds
  /// of bodies that may fall asleep, and remembered normals are those of a new world in one that goes on from it.
  WorldState save() const;

  /// Takes the lid off a hopper's outlet; call it once.
  void open_outlet() { container_geoms_->open_outlet(); }

 private:
  explicit World(const Scene& scene);
  void add_cell();
  void set_parameters(const Scene& scene);
  void add_grain(const Placement& placement);
  void restore(const SavedGrain& saved);

  const Scene& scene_;
  QueryDefaults query_defaults_;  // before any geom
  dWorldID world_;
  std::unique_ptr<SweepSpace> sweep_;
  std::unique_ptr<supernormal::effects::Effects> effects_;
  std::vector<Grain> grains_;
  std::vector<std::size_t> present_;  // indices of the bodies that are there, in order
  std::optional<ContainerGeoms> container_geoms_;
  std::unique_ptr<PeriodicCell> cell_;
  std::unique_ptr<WallBodies> walls_;
};

}  // namespace falling_particles
