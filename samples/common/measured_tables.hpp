// What programs that measure share: the machine, tables that are made by tasks and can be resumed, numbers as text, and a script at
// the end.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace common {

/// Names and values, as a table of measurements begins with them.
using Environment = std::vector<std::pair<std::string, std::string>>;

/// Processor, compiler, flags, commit, and the version of Eigen. A program adds the libraries that it measures.
Environment environment();

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

/// Formats a number for readable tables, by printf with a format of one double. "–" for NaN.
std::string text(const char* format, double value);

/// Formats a number for CSV with six digits.
std::string number(double value);

/// Becomes Debian's Python running this script with one argument. Throws if it cannot be run.
[[noreturn]] void become_python(const std::string& script, const std::string& argument);

}  // namespace common
