// Grains that are inserted and removed during a run.
#pragma once

#include <ode/ode.h>

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/random.hpp"
#include "model/feeder.hpp"
#include "model/geometry.hpp"
#include "model/scene.hpp"
#include "placement.hpp"
#include "world.hpp"

namespace falling_particles {

/// A grain in a world of its own, so that other grains do not collide with it.
class Candidate {
 public:
  /// `scale`: factor on the lengths of the kind, which must outlive this object. Throws std::runtime_error when the library refuses
  /// the grain.
  Candidate(const GrainKind& kind, double scale);
  ~Candidate();
  Candidate(const Candidate&) = delete;
  Candidate& operator=(const Candidate&) = delete;

  const Grain& grain() const { return grain_; }
  const std::vector<dGeomID>& geoms() const { return geoms_; }
  void put(const Placement& place) const { falling_particles::put(grain_.body, place); }

 private:
  dWorldID world_;
  Grain grain_;
  std::vector<dGeomID> geoms_;
};

/// The geoms in a region of a world at one time.
class Neighbourhood {
 public:
  /// Contains the grains, their images in a periodic world, and the walls whose bounding boxes meet the region.
  Neighbourhood(const World& world, const Region& region);

  void add(dGeomID geom) { geoms_.push_back(geom); }
  /// Whether `geom`, of the library's class, overlaps none of them, to the tolerance of snGeomProximity. A wall that is a surface,
  /// a mesh or a terrain, overlaps no grain behind it. Throws std::runtime_error.
  bool is_free(dGeomID geom) const;

 private:
  std::vector<dGeomID> geoms_;
};

/// The state of a feeder, which a resumed run restores.
struct FeederState {
  /// The next grain, which is inserted as soon as it is due.
  struct Next {
    std::size_t kind;  ///< index into Feeder::mixture
    double scale;      ///< of the grain's lengths
    void serialize(auto& archive) { archive(kind, scale); }
  };
  Next next = {};
  std::vector<Amount> fed = {};             ///< of each kind of Feeder::mixture
  Random random;                            ///< for sizes, positions and orientations
  std::optional<double> behind_since = {};  ///< s, time since which due grains have found no place
  Amount when_behind = {};                  ///< the amount that had been fed at that time

  void serialize(auto& archive) { archive(next, fed, random, behind_since, when_behind); }
};

/// Inserts the grains of one feeder. A grain is due whenever the integral of the rate since the start passes a whole grain. A due
/// grain that finds no place stays due. The next kind follows from the fractions and the amounts fed so far, without random
/// numbers: at any time the mixture is exact to one grain. Sizes, positions and orientations come from random numbers of the
/// feeder's own.
class Feeding {
 public:
  /// The feeder and the world must outlive this object. `seed` is the scene's seed; `number` is the feeder's index in the scene.
  Feeding(const Feeder& feeder, World& world, std::uint64_t seed, std::uint64_t number);

  /// Inserts the grains that are due until `now` (s), and returns their indices, valid until the next call. Throws
  /// std::runtime_error when the region has been too full for longer than the feeder's timeout (Feeder::patience).
  std::span<const std::size_t> feed(double now);

  const Feeder& feeder() const { return feeder_; }
  const GrainKind& kind(std::size_t i) const;  ///< the kind of Feeder::mixture[i]
  const FeederState& state() const { return state_; }
  Amount fed() const;  ///< of all kinds together

  void serialize(auto& archive) { archive(state_); }

 private:
  std::size_t next_kind() const;
  void choose_next();
  Candidate& candidate();
  bool is_due(double now);
  std::optional<Placement> find_place(const Neighbourhood& neighbourhood);
  void check_timeout(double now);

  const Feeder& feeder_;
  World& world_;
  FeederState state_;
  std::vector<std::unique_ptr<Candidate>> candidates_;  // the last candidate of each kind of the mixture
  std::vector<std::size_t> last_;
};

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
  void serialize(auto& archive) {
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
