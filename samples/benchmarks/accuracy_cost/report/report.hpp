// The measurements as tables.
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

/// Markdown for a terminal or a README.
void write_markdown(const Results& results, std::ostream& out);

/// A line per class, situation and method; where it was measured, as comment lines first. Throws when it cannot be written.
void write_csv(const Results& results, const std::string& path);

}  // namespace accuracy_cost
