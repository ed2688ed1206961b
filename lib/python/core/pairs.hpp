// N pairs of bodies.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "batch_arguments.hpp"
#include "supernormal/proximity/batch.hpp"

namespace supernormal::python {

/// Bodies, poses and first normals: one for all pairs, or one for each.
class Pairs {
 public:
  Pairs(const pybind11::object& shapes1, const pybind11::object& poses1, const pybind11::object& shapes2,
        const pybind11::object& poses2, const std::optional<Doubles>& first_normals = std::nullopt);

  std::ptrdiff_t count() const { return count_.value(); }
  PairCount& counted() { return count_; }  ///< for further arguments

  /// The question about pair i. `first` keeps its first normal.
  ProximityQuery query(std::ptrdiff_t i, Vector3& first) const;

  /// Pairs that are asked together: vector lanes are full, and the stack takes 20 kB.
  static constexpr std::size_t kAtOnce = 64;

  /// Asks the pairs from i to `end`, and advances i: many(queries, pairs) of bodies that never throw, one(query, pair) of others.
  template <typename Many, typename One>
  void for_batches(std::ptrdiff_t& i, std::ptrdiff_t end, Many many, One one) const {
    std::array<Vector3, kAtOnce> normals;
    std::array<ProximityQuery, kAtOnce> queries{};
    std::array<std::ptrdiff_t, kAtOnce> pairs{};
    std::size_t size = 0;
    const auto ask = [&] {
      many(std::span<const ProximityQuery>(queries.data(), size), std::span<const std::ptrdiff_t>(pairs.data(), size));
    };
    for (; i < end; ++i) {
      pairs[size] = i;
      queries[size] = query(i, normals[size]);
      // A shape of the program's own may throw, and then its index counts.
      if (!is_cheaper_together(queries[size])) {
        one(queries[size], i);
      } else if (++size == kAtOnce) {
        ask();
        size = 0;
      }
    }
    ask();
  }

 private:
  static bool is_cheaper_together(const ProximityQuery& query);

  PairCount count_;
  ShapesArgument shapes1_;
  PosesArgument poses1_;
  ShapesArgument shapes2_;
  PosesArgument poses2_;
  std::optional<VectorsArgument> first_;
};

}  // namespace supernormal::python
