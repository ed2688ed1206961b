// A feeder at work.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/random.hpp"
#include "candidate.hpp"
#include "model/feeder.hpp"
#include "world.hpp"

namespace falling_particles {

/// All that a feeder remembers: what a resumed run has to restore.
struct FeederState {
  /// The grain that comes next, as soon as it is due.
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
  Random random;                            ///< for sizes, places and attitudes
  std::optional<double> behind_since = {};  ///< s, since when grains that are due have found no place
  Amount when_behind = {};                  ///< what had been fed then

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(next, fed, random, behind_since, when_behind);
  }
};

/// Feeds the grains of one feeder. A grain is due as soon as the rate, added up since the start, is owed a whole one; one that
/// finds no place stays due. Which kind is next follows from the fractions and what has been fed, without chance: the mixture is
/// exact to a grain at any time. Sizes, places and attitudes come from random numbers of the feeder's own.
class Feeding {
 public:
  /// The feeder and the world must outlive this object. `seed`: of the scene; `number`: of the feeder in it.
  Feeding(const Feeder& feeder, World& world, std::uint64_t seed, std::uint64_t number);

  /// Feeds what is due until `now` (s), and returns the indices of these grains, which end before the next call. Throws
  /// std::runtime_error when the region has been too full for longer than the feeder's patience.
  std::span<const std::size_t> feed(double now);

  const Feeder& feeder() const { return feeder_; }
  const GrainKind& kind(std::size_t i) const;  ///< of Feeder::mixture
  const FeederState& state() const { return state_; }
  Amount fed() const;  ///< of all kinds

  template <typename Archive>
  void serialize(Archive& archive) {
    archive(state_);
  }

 private:
  std::size_t next_kind() const;
  void choose_next();
  Candidate& candidate();
  bool is_due(double now);
  std::optional<Placement> find_place(const class Neighbourhood& neighbourhood);
  void check_patience(double now);

  const Feeder& feeder_;
  World& world_;
  FeederState state_;
  std::vector<std::unique_ptr<Candidate>> candidates_;  // the last one of each kind of the mixture
  std::vector<std::size_t> last_;
};

}  // namespace falling_particles
