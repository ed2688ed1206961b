// The ODE world of a scene.
#pragma once

#include <ode/ode.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <supernormal/effects.hpp>
#include <supernormal/stepper.hpp>
#include <vector>

#include "bonds.hpp"
#include "grain.hpp"
#include "model/geometry.hpp"
#include "model/scene.hpp"
#include "periodic_cell.hpp"
#include "sweep_space.hpp"
#include "wall_bodies.hpp"

namespace falling_particles {

/// A present grain, or the data of a removed one.
struct SavedGrain {
  std::uint64_t kind = 0;  ///< index into Scene::kinds
  double scale = 1;        ///< of the grain's lengths
  double mass = 0;         ///< kg
  bool is_present = true;
  bool is_awake = true;
  Point position = {};  ///< m
  std::array<double, 4> quaternion = {1, 0, 0, 0};
  Point velocity = {};          ///< m/s
  Point angular_velocity = {};  ///< rad/s

  void serialize(auto& archive) {
    archive(kind, scale, mass, is_present, is_awake, position, quaternion, velocity, angular_velocity);
  }
};

struct WorldState {
  std::uint64_t seed = 0;          ///< of ODE's random numbers
  std::vector<SavedGrain> grains;  ///< all grains so far
  bool has_lid = false;            ///< whether a hopper's outlet has its lid
  Point periods = {};              ///< m, of the cell along x, y and z; 0 along axes that are not periodic
  WallsState walls;
  BondsState bonds;
  std::vector<double> stepper;  ///< what it remembers (snStepperSave)

  void serialize(auto& archive) { archive(seed, grains, has_lid, periods, walls, bonds, stepper); }
};

/// The present grains of a list, in its order. Removed grains cost no time.
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

/// Sets the library's defaults for queries, which hold for the process. The end of its lifetime resets them. Without a section
/// [query] it does nothing. Throws std::runtime_error when the library refuses the values.
class QueryDefaults {
 public:
  explicit QueryDefaults(const std::optional<Query>& query);
  ~QueryDefaults();
  QueryDefaults(const QueryDefaults&) = delete;
  QueryDefaults& operator=(const QueryDefaults&) = delete;

 private:
  bool are_changed_;
};

/// The ODE world of a scene, which must outlive it.
class World {
 public:
  /// A world with a grain at each placement. Throws std::runtime_error when the library refuses a body.
  World(const Scene& scene, const std::vector<Placement>& placements);
  /// Resumes from a state of the same scene.
  struct GoOn {};
  World(const Scene& scene, GoOn how, const WorldState& state);
  World(const Scene&& scene, const std::vector<Placement>& placements) = delete;  // the scene would not outlive the world
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  dWorldID id() const { return world_; }
  const Scene& scene() const { return scene_; }
  /// The space of the grains and their images; walls are not in it.
  SweepSpace& sweep() const { return *sweep_; }
  /// All grains so far, removed ones included.
  const std::vector<Grain>& grains() const { return grains_; }
  /// The present ones of grains().
  PresentGrains present() const { return {grains_.data(), present_}; }
  /// Calls visit(geom) for the geoms of all present grains, and of their images in a periodic world.
  void for_each_grain_geom(const auto& visit) const {
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
  /// m, the centre of a grain; in a periodic world, its image within the cell.
  Point place_of(const Grain& grain) const { return cell_ == nullptr ? grain.position() : cell_->wrapped(grain.position()); }
  std::size_t index_of(const Grain& grain) const { return static_cast<std::size_t>(&grain - grains_.data()); }
  /// The effects that the scene names, compiled.
  supernormal::effects::Effects& effects() const { return *effects_; }
  /// Moves the bodies in place of dWorldQuickStep; null for a scene that takes quickstep.
  supernormal::ode::Stepper* stepper() const { return stepper_.get(); }
  /// Calls back for every pair of a grain and a wall whose bounding boxes meet.
  void name_wall_pairs(void* data, dNearCallback* callback) const;
  /// Calls back for every pair of grains, or of a grain and a wall, whose bounding boxes meet.
  void name_pairs(void* data, dNearCallback* callback) const;
  PeriodicCell* cell() const { return cell_.get(); }  ///< null for a scene without periodic axes
  Bonds* bonds() const { return bonds_.get(); }       ///< null for a scene without bonds
  WallBodies& walls() const { return *walls_; }       ///< of Scene::walls

  /// Inserts a grain and returns its index, the next one. Not during a step.
  std::size_t insert(const Placement& placement);
  /// Removes a grain. Not during a step. It invalidates the grain's contacts of the last step.
  void remove(std::size_t index);

  /// The state to resume from. Reset on resume: ODE's internal order of bodies, geoms and joints, its auto-disable history, and
  /// warm-start normals.
  WorldState save() const;

  /// Removes the lid of a hopper's outlet.
  void open_outlet() { walls_->remove_lid(); }

 private:
  explicit World(const Scene& scene);
  void add_cell();
  void set_parameters(const Scene& scene);
  void add_grain(const Placement& placement);
  void restore(const SavedGrain& saved);
  std::vector<dGeomID> all_geoms() const;  // of present grains and walls, in an order that a saved world has, too

  const Scene& scene_;
  QueryDefaults query_defaults_;  // set before any geom exists
  dWorldID world_;
  std::unique_ptr<SweepSpace> sweep_;
  std::unique_ptr<supernormal::effects::Effects> effects_;
  std::unique_ptr<supernormal::ode::Stepper> stepper_;
  std::vector<Grain> grains_;
  std::vector<std::size_t> present_;  // indices of the present grains, in order
  std::unique_ptr<PeriodicCell> cell_;
  std::unique_ptr<WallBodies> walls_;
  std::unique_ptr<Bonds> bonds_;
};

}  // namespace falling_particles
