// The last frame of a table of grains.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/interval.hpp"

namespace falling_particles {

using namespace common;

/// Named columns of words, from a CSV file or from a text dump of LAMMPS. Of several frames the last one is read: the lines of
/// the largest time_s of a CSV file, the last section of a dump. The columns of a dump get the names that the tables of a run have,
/// where they mean the same.
class StateTable {
 public:
  struct Row {
    unsigned line;  ///< of the file
    std::vector<std::string_view> fields;
  };

  /// Throws InputError, which names the file and the line.
  explicit StateTable(const std::filesystem::path& path);
  StateTable(const StateTable&) = delete;
  StateTable& operator=(const StateTable&) = delete;

  bool is_dump() const { return is_dump_; }
  std::optional<double> time() const { return time_; }  ///< s
  const std::vector<Row>& rows() const { return rows_; }
  bool has(std::string_view column) const;
  /// Throws InputError unless the table has all the columns. `why` ends the message.
  void require(const std::vector<std::string>& columns, const std::string& why = "") const;
  /// Throws InputError when the table has other columns.
  void refuse_others(const std::vector<std::string>& columns) const;

  std::string_view word(const Row& row, std::string_view column) const;
  double number(const Row& row, std::string_view column, const Interval& allowed) const;
  std::size_t whole_number(const Row& row, std::string_view column, std::size_t least, std::size_t most) const;

  [[noreturn]] void fail(unsigned line, const std::string& text) const;

 private:
  struct Line {
    unsigned number;
    std::string_view text;
  };
  class Lines;
  void read_csv(Lines& lines);
  void read_dump(Lines& lines);
  void read_frame(Lines& lines, std::size_t atoms);
  void add_row(const Line& line, std::vector<std::string_view> fields);
  std::size_t index_of(std::string_view column) const;

  std::filesystem::path path_;
  std::string text_;
  bool is_dump_ = false;
  unsigned head_ = 1;  // line of the columns
  std::vector<std::string> columns_;
  std::vector<Row> rows_;
  std::optional<double> time_;
};

}  // namespace falling_particles
