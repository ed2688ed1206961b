// Other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace falling_particles {

/// How a program ended.
struct ProgramEnd {
  bool is_installed;     ///< whether PATH has the program; if not, the rest is empty
  bool has_succeeded;    ///< exit code 0
  std::string output;    ///< its stdout
  std::string messages;  ///< its stderr; of a program that has not succeeded, with how it ended
};

/// Runs a program of PATH, without a shell, in `folder` with `input` as its stdin, and waits. After Ctrl-C (interrupt.hpp) the
/// program is ended. Throws std::runtime_error when the machine cannot start programs.
ProgramEnd run_program(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::string& input);

}  // namespace falling_particles
