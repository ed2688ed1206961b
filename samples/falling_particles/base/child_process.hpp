// Running other programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace falling_particles {

/// The outcome of a program.
struct ProgramEnd {
  bool is_installed;     ///< whether PATH has the program; otherwise the other members are empty
  bool has_succeeded;    ///< exit code 0
  std::string output;    ///< its stdout
  std::string messages;  ///< its stderr; after a failure also how the program ended
};

/// Runs a program of PATH without a shell, in `folder`, with `input` as its stdin, and waits for it. Ctrl-C (interrupt.hpp) ends
/// the program. Throws std::runtime_error when the machine cannot start programs.
ProgramEnd run_program(const std::vector<std::string>& command, const std::filesystem::path& folder, const std::string& input);

}  // namespace falling_particles
