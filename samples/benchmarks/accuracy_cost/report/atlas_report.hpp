// A report on the atlas in plain language.
#pragma once

#include <string>

namespace accuracy_cost {

/// Reads the tables in `folder` and writes `folder`/report.md: tables, figures (which figures.gp draws) and conclusions. Parts
/// that were not measured are left out. Throws when it cannot be written.
void write_report(const std::string& folder);

}  // namespace accuracy_cost
