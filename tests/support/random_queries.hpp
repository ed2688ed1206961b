// Queries of random pairs.
#pragma once

#include <algorithm>
#include <deque>
#include <memory>
#include <random>
#include <vector>

#include "supernormal/proximity/batch.hpp"
#include "supernormal/proximity/solve.hpp"
#include "support/random_bodies.hpp"

namespace supernormal::test {

/// Owns all that its queries refer to. A derived class draws.
class RandomQueries {
 public:
  const std::vector<ProximityQuery>& queries() const { return queries_; }
  void shuffle(unsigned seed) { std::shuffle(queries_.begin(), queries_.end(), std::mt19937(seed)); }

 protected:
  /// A source of pairs of a kind.
  RandomBodies& bodies_of(const RandomKind& kind, unsigned seed) {
    return *bodies_.emplace_back(std::make_unique<RandomBodies>(kind, seed));
  }

  /// Keeps the pair, and a normal near its common one.
  void add(const RandomPair& pair) {
    pairs_.push_back(pair);
    normals_.push_back(find_proximity(*pair.shape1, kPlace, *pair.shape2, pair.pose2, {.tolerance = 1e-3}).normal);
  }

  std::size_t pair_count() const { return pairs_.size(); }
  const Vector3* normal(std::size_t pair) const { return &normals_[pair]; }
  void ask(std::size_t pair, const Vector3* first_normal) {
    queries_.push_back({pairs_[pair].shape1.get(), &kPlace, pairs_[pair].shape2.get(), &pairs_[pair].pose2, first_normal});
  }

 private:
  inline static const Pose kPlace;
  std::vector<std::unique_ptr<RandomBodies>> bodies_;  // they hold vertices that the pairs refer to
  std::deque<RandomPair> pairs_;                       // the places of both stay
  std::deque<Vector3> normals_;
  std::vector<ProximityQuery> queries_;
};

}  // namespace supernormal::test
