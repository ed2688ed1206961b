#include "hash.hpp"

#include <xxhash.h>

#include <new>
#include <string>

#include "common/read_file.hpp"

namespace falling_particles {

using namespace common;

Hash hash_of(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

RunningHash::RunningHash() : state_(XXH3_createState()) {
  if (!state_ || XXH3_128bits_reset(state_.get()) == XXH_ERROR) throw std::bad_alloc();
}

void RunningHash::add(std::string_view bytes) { XXH3_128bits_update(state_.get(), bytes.data(), bytes.size()); }

Hash RunningHash::value() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
  return {hash.low64, hash.high64};
}

void RunningHash::Free::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }

Hash hash_of_file(const std::filesystem::path& path) { return hash_of(read_file(path)); }

}  // namespace falling_particles
