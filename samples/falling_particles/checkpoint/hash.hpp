// Checksums.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>

namespace falling_particles {

/// XXH3 with 128 bits: tells texts apart unless somebody makes them alike on purpose.
using Hash = std::array<std::uint64_t, 2>;

Hash hash_of(std::string_view bytes);

/// Of a file's content. Throws std::runtime_error when it cannot be read.
Hash hash_of_file(const std::filesystem::path& path);

}  // namespace falling_particles
