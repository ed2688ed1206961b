// Whole files as bytes.
#pragma once

#include <filesystem>
#include <string>

namespace common {

/// The kind of a path that is no file: "a folder", "a pipe or a socket", "a device". Empty for a file, a link to a file, or
/// nothing. Reading a pipe would block, and a device has no end.
std::string what_is_no_file(const std::filesystem::path& path);

/// Reads a whole file. Throws std::runtime_error when it cannot be read, or is no file.
std::string read_file(const std::filesystem::path& path);

}  // namespace common
