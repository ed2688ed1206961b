#include "csv_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace accuracy_cost {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) {
    std::erase(cell, '"');
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace

CsvTable::CsvTable(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> columns;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("# done")) continue;
    if (line.starts_with("# ")) {
      comments_.push_back(line.substr(2));
    } else if (columns.empty()) {
      columns = split(line);
    } else {
      const std::vector<std::string> cells = split(line);
      Row row;
      for (std::size_t k = 0; k < std::min(cells.size(), columns.size()); ++k) row[columns[k]] = cells[k];
      rows_.push_back(std::move(row));
    }
  }
}

const Row* CsvTable::find(std::initializer_list<std::pair<std::string, std::string>> cells) const {
  const auto found = std::ranges::find_if(rows_, [&](const Row& row) {
    return std::ranges::all_of(cells, [&](const auto& cell) {
      const auto place = row.find(cell.first);
      return place != row.end() && place->second == cell.second;
    });
  });
  return found == rows_.end() ? nullptr : &*found;
}

double CsvTable::value(std::initializer_list<std::pair<std::string, std::string>> cells, const std::string& column) const {
  const Row* const row = find(cells);
  return row == nullptr ? std::numeric_limits<double>::quiet_NaN() : number_in(*row, column);
}

double number_in(const Row& row, const std::string& column) {
  const auto cell = row.find(column);
  return cell == row.end() || cell->second.empty() ? std::numeric_limits<double>::quiet_NaN()
                                                   : std::strtod(cell->second.c_str(), nullptr);
}

}  // namespace accuracy_cost
