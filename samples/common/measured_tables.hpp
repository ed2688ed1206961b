// Tables of measurements, made by tasks that can be interrupted and resumed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/environment.hpp"

namespace common {

/// Some lines of a table that are measured together.
struct MeasuringTask {
  std::string name;                               ///< unique within the table
  std::function<std::vector<std::string>()> run;  ///< lines of CSV
};

/// The table <name>.csv.
struct MeasuredTable {
  std::string name;
  std::string header;  ///< header line of the CSV file
  std::vector<MeasuringTask> tasks;
};

/// Joins cells to a CSV line.
std::string joined(const std::vector<std::string>& cells);

/// Runs the tasks whose lines are missing in `folder`, with a progress bar on stderr. A new file begins with the environment. The
/// lines of each task are on disk before the next task starts. Throws if a file cannot be written.
void measure_tables(const std::vector<MeasuredTable>& tables, const Environment& environment, const std::string& folder);

}  // namespace common
