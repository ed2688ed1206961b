// Pictures that other programs make of the files of a run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace falling_particles {

struct Rendering {
  std::string file;                  ///< name of the picture, which the program writes to its stdout
  std::vector<std::string> command;  ///< program and arguments; it runs in the folder of the results
  std::string input;                 ///< its stdin
  std::string_view package;          ///< of Debian, that has the program
};

/// Makes the pictures in `folder`. What could not be made, because its program is not installed or fails, and what is left after
/// Ctrl-C, is told on stderr. Throws std::runtime_error when a picture could not be written.
void render(const std::vector<Rendering>& renderings, const std::filesystem::path& folder, bool quiet);

}  // namespace falling_particles
