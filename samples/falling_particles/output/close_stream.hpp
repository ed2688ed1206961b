// The end of a file.
#pragma once

#include <filesystem>
#include <fstream>

namespace falling_particles {

/// Throws std::runtime_error when anything could not be written.
void close_or_throw(std::ofstream& stream, const std::filesystem::path& path);

}  // namespace falling_particles
