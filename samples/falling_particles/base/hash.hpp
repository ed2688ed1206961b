// Checksums.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

struct XXH3_state_s;

namespace falling_particles {

/// An XXH3 hash of 128 bits. It distinguishes texts unless somebody makes them collide on purpose.
using Hash = std::array<std::uint64_t, 2>;

Hash hash_of(std::string_view bytes);

/// Hashes bytes that arrive piece by piece.
class RunningHash {
 public:
  RunningHash();
  void add(std::string_view bytes);
  Hash value() const;  ///< of all bytes so far

 private:
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;
};

/// Hashes the content of a file. Throws std::runtime_error when the file cannot be read.
Hash hash_of_file(const std::filesystem::path& path);

}  // namespace falling_particles
