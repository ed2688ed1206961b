// The measurements of the whole atlas as tasks that can be interrupted and resumed.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace accuracy_cost {

/// A task: some lines of a table, measured together.
struct Task {
  std::string name;                               ///< unique in its part
  std::function<std::vector<std::string>()> run;  ///< lines of CSV
};

/// A part of the atlas: the table <name>.csv.
struct Part {
  std::string name;
  std::string header;  ///< header line of the CSV file
  std::vector<Task> tasks;
};

/// Joins cells to a line of CSV.
std::string joined(const std::vector<std::string>& cells);

/// Does those tasks whose lines `folder` does not have yet, with a progress bar on stderr. A file begins with the machine and the
/// libraries that it was measured with; each task's lines are on the disk before the next task starts. Throws when they cannot be
/// written.
void run_parts(const std::vector<Part>& parts, const std::string& folder);

}  // namespace accuracy_cost
