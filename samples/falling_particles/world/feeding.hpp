// The insertion of grains by a feeder.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/random.hpp"
#include "free_places.hpp"
#include "model/feeder.hpp"
#include "world.hpp"

namespace falling_particles {

/// The state of a feeder, which a resumed run restores.
struct FeederState {
  /// The next grain, which is inserted as soon as it is due.
  struct Next {
    std::size_t kind;  ///< index into Feeder::mixture
    double scale;      ///< of the grain's lengths
    template <typename Archive>
    void serialize(Archive& archive) {
      archive(kind, scale);
    }
  };
  Next next = {};
  std::vector<Amount> fed = {};             ///< of each kind of Feeder::mixture
  Random random;                            ///< for sizes, positions and orientations
  std::optional<double> behind_since = {};  ///< s, time since which due grains have found no place
  Amount when_behind = {};                  ///< the amount that had been fed at that time

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(next, fed, random, behind_since, when_behind);
  }
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

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(state_);
  }

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

}  // namespace falling_particles
