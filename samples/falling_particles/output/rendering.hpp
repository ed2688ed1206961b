// The pictures that other programs make from the files of a run.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
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

struct Rendering {
  std::string file;                  ///< name of the picture, which the program writes to its stdout
  std::vector<std::string> command;  ///< program and arguments; it runs in the folder of the results
  std::string input;                 ///< its stdin
  std::string_view package;          ///< the Debian package of the program
};

/// Makes the pictures in `folder`. If a program is missing or fails, or after Ctrl-C, it reports the missing pictures on stderr and
/// still succeeds. Throws std::runtime_error when a picture could not be written.
void render(const std::vector<Rendering>& renderings, const std::filesystem::path& folder, bool quiet);

}  // namespace falling_particles
