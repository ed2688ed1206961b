// Reads the tables of run_parts().
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace accuracy_cost {

using Row = std::map<std::string, std::string>;  // by column name

class CsvTable {
 public:
  /// Empty if the file does not exist. Cells may be quoted but must not contain commas.
  explicit CsvTable(const std::string& path);

  const std::vector<std::string>& comments() const { return comments_; }  ///< without the notes on finished tasks
  const std::vector<Row>& rows() const { return rows_; }

  /// The first row with these cells; null if there is none.
  const Row* find(std::initializer_list<std::pair<std::string, std::string>> cells) const;

  /// A number of this row; NaN if there is none.
  double value(std::initializer_list<std::pair<std::string, std::string>> cells, const std::string& column) const;

 private:
  std::vector<std::string> comments_;
  std::vector<Row> rows_;
};

double number_in(const Row& row, const std::string& column);

}  // namespace accuracy_cost
