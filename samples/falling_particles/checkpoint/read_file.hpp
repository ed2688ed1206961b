// Whole files as bytes.
#pragma once

#include <filesystem>
#include <string>

namespace falling_particles {

/// Throws std::runtime_error when the file cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace falling_particles
