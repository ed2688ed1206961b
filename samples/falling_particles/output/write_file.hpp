// Writing files without losing anything in silence.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace falling_particles {

/// Throws std::runtime_error when anything could not be written.
void close_or_throw(std::ofstream& stream, const std::filesystem::path& path);

/// Writes a whole file; throws std::runtime_error when that is not possible.
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace falling_particles
