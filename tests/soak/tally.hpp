// The results of the soak program so far, and their file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "examination.hpp"

namespace supernormal::soak {

/// The samples with the largest values, largest first.
class Ranking {
 public:
  struct Entry {
    double value = 0;
    std::uint64_t sample = 0;
  };

  void add(const Entry& entry);
  void add(const Ranking& other) {
    for (const Entry& entry : other.entries_) add(entry);
  }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  static constexpr std::size_t kLength = 5;

  std::vector<Entry> entries_;
};

struct Tally {
  std::uint64_t samples = 0, queries = 0, evaluations = 0;
  std::uint64_t not_global = 0,
                not_converged = 0;      ///< samples with an answer that does not claim to be global, or to have converged
  std::uint64_t violations = 0;         ///< samples with at least one violation
  double seconds = 0;                   ///< real time
  std::vector<std::uint64_t> violated;  ///< the first of the samples with violations
  Ranking by_error, by_error_of_bound, by_evaluations;

  void add(std::uint64_t sample, const Finding& finding);

  /// Adds everything except the time.
  void add(const Tally& other);
};

/// Writes a new file and renames it, so the file is always complete.
void save(const Tally& tally, std::uint64_t seed, const std::string& path);

/// Loads a saved tally, or a new one if there is no file. Throws std::runtime_error if the file is not a tally, or is of another
/// seed.
Tally load(std::uint64_t seed, const std::string& path);

}  // namespace supernormal::soak
