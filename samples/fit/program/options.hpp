// The command line of fit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/body.hpp"

namespace fit {

struct Options {
  std::vector<std::string> paths;  ///< files and folders
  std::string shape = "auto";
  std::string noise = "auto";
  std::string outliers = "auto";
  std::string table = "auto";
  std::string group;
  double scale = 1;  ///< metres in a unit of the files
  double density = 1000;
  std::string name;
  std::string out = "out/fit";
  std::string sides = "auto";
  ShapeLimits limits;
  bool uses_vertices = false;
  bool is_quick = false;
  int bodies = 1;
  int threads = 1;
};

/// Reads the command line. Returns the exit code if the program ends here: 0 after --help, 2 for a wrong option. Throws
/// std::invalid_argument for options that contradict one another.
std::optional<int> read_options(int argc, char** argv, Options& options);

}  // namespace fit
