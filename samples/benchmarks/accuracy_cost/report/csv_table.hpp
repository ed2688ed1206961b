// Reads the tables that run_parts() wrote.
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace accuracy_cost {

using Row = std::map<std::string, std::string>;  // by the names of the columns

class CsvTable {
 public:
  /// Empty when there is no such file. Cells may be quoted but have no commas in them.
  explicit CsvTable(const std::string& path);

  const std::vector<std::string>& comments() const { return comments_; }  ///< without notes of finished tasks
  const std::vector<Row>& rows() const { return rows_; }

  /// The first row with these cells; null when there is none.
  const Row* find(std::initializer_list<std::pair<std::string, std::string>> cells) const;

  /// A number of that row; NaN when there is none.
  double value(std::initializer_list<std::pair<std::string, std::string>> cells, const std::string& column) const;

 private:
  std::vector<std::string> comments_;
  std::vector<Row> rows_;
};

double number_in(const Row& row, const std::string& column);

}  // namespace accuracy_cost
