// A report on the atlas in plain language.
#pragma once

#include <string>

namespace accuracy_cost {

/// Reads the tables in `folder` and writes `folder`/report.md: tables, figures (drawn by figures.gp) and conclusions. Parts without
/// measurements are omitted. Throws if the report cannot be written.
void write_report(const std::string& folder);

}  // namespace accuracy_cost
