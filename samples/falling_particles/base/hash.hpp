// Checksums.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>

struct XXH3_state_s;

namespace falling_particles {

/// XXH3 with 128 bits: tells texts apart unless somebody makes them alike on purpose.
using Hash = std::array<std::uint64_t, 2>;

Hash hash_of(std::string_view bytes);

/// The hash of bytes that come piece by piece.
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

/// Of a file's content. Throws std::runtime_error when it cannot be read.
Hash hash_of_file(const std::filesystem::path& path);

}  // namespace falling_particles
