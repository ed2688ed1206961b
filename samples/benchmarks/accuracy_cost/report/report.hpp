// Writes the measurements as tables.
#pragma once

#include <ostream>
#include <string>

#include "measurement.hpp"

namespace accuracy_cost {

struct Results {
  const std::vector<Pair>& pairs;
  const Methods& methods;
  const std::vector<std::vector<Sample>>& samples;  ///< [method][pair]
};

/// Writes Markdown for a terminal or a README.
void write_markdown(const Results& results, std::ostream& out);

/// Writes a line for each class, situation and method, after the environment as comment lines. Throws if the file cannot be
/// written.
void write_csv(const Results& results, const std::string& path);

}  // namespace accuracy_cost
