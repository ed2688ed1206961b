// Whole files as bytes.
#pragma once

#include <filesystem>
#include <string>

namespace falling_particles {

/// What is in the place of a file that is to be read: "a folder", "a pipe or a socket", "a device". Empty for a file, a link to
/// one, or nothing. A pipe would be waited for, and a device has no end.
std::string what_is_no_file(const std::filesystem::path& path);

/// Throws std::runtime_error when the file cannot be read, or is no file.
std::string read_file(const std::filesystem::path& path);

}  // namespace falling_particles
