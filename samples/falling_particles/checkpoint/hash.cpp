#include "checkpoint/hash.hpp"

#include <xxhash.h>

#include <string>

#include "checkpoint/read_file.hpp"

namespace falling_particles {

Hash hash_of(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

Hash hash_of_file(const std::filesystem::path& path) { return hash_of(read_file(path)); }

}  // namespace falling_particles
