// The measurements of the whole atlas as tasks that can be interrupted and resumed.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace accuracy_cost {

/// Some lines of a table, measured together.
struct Task {
  std::string name;                               ///< unique in its part
  std::function<std::vector<std::string>()> run;  ///< lines of CSV
};

/// A table of the atlas: <name>.csv.
struct Part {
  std::string name;
  std::string header;  ///< of the CSV
  std::vector<Task> tasks;
};

/// A line of CSV.
std::string joined(const std::vector<std::string>& cells);

/// Does the tasks that `folder` does not have the lines of, with a progress bar on stderr. A file begins with where and with what
/// it was measured; each task's lines are on the disk before the next task starts. Throws when they cannot be written.
void run_parts(const std::vector<Part>& parts, const std::string& folder);

}  // namespace accuracy_cost
