// The measurements of the atlas, as tasks that can be interrupted and resumed.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace accuracy_cost {

/// A task: some lines of a table that are measured together.
struct Task {
  std::string name;                               ///< unique within the part
  std::function<std::vector<std::string>()> run;  ///< lines of CSV
};

/// A part of the atlas: the table <name>.csv.
struct Part {
  std::string name;
  std::string header;  ///< header line of the CSV file
  std::vector<Task> tasks;
};

/// Joins cells to a CSV line.
std::string joined(const std::vector<std::string>& cells);

/// Runs the tasks whose lines are missing in `folder`, with a progress bar on stderr. A file begins with the machine and the
/// versions of the libraries. The lines of each task are on disk before the next task starts. Throws if a file cannot be written.
void run_parts(const std::vector<Part>& parts, const std::string& folder);

}  // namespace accuracy_cost
