// Random numbers that are the same on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>

namespace common {

/// Random numbers that are the same everywhere. The standard defines the engine bit for bit but leaves the distributions to each
/// library, so they are implemented here.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  double uniform();                        ///< in [0, 1)
  std::uint64_t below(std::uint64_t end);  ///< in [0, end), each equally likely
  std::array<double, 4> rotation();        ///< unit quaternion w, x, y, z; uniform over all rotations

  std::string state() const;  ///< text; after restore() the same numbers follow
  void restore(const std::string& state);
  template <typename Archive>
  std::string save_minimal(const Archive& /*archive*/) const {
    return state();
  }
  template <typename Archive>
  void load_minimal(const Archive& /*archive*/, const std::string& state) {
    restore(state);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace common
