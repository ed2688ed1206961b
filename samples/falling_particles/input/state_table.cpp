#include "state_table.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "common/input_error.hpp"
#include "common/nearest_word.hpp"
#include "common/read_file.hpp"

namespace falling_particles {
namespace {

constexpr std::string_view kBlanks = " \t\r";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // which spreadsheets write in front of UTF-8

/// Columns of dumps: of output/lammps_dump.cpp, and of the dump that output/lammps_input.cpp requests.
constexpr std::array<std::pair<std::string_view, std::string_view>, 24> kNamesOfDumps = {{
    {"id", "body"},
    {"x", "x_m"},
    {"y", "y_m"},
    {"z", "z_m"},
    {"xu", "x_m"},
    {"yu", "y_m"},
    {"zu", "z_m"},
    {"quatw", "qw"},
    {"quati", "qx"},
    {"quatj", "qy"},
    {"quatk", "qz"},
    {"vx", "vx_m_per_s"},
    {"vy", "vy_m_per_s"},
    {"vz", "vz_m_per_s"},
    {"omegax", "wx_rad_per_s"},
    {"omegay", "wy_rad_per_s"},
    {"omegaz", "wz_rad_per_s"},
    {"c_shape[1]", "shapex"},
    {"c_shape[2]", "shapey"},
    {"c_shape[3]", "shapez"},
    {"c_shape[4]", "qx"},
    {"c_shape[5]", "qy"},
    {"c_shape[6]", "qz"},
    {"c_shape[7]", "qw"},
}};

std::string_view trimmed(std::string_view text) {
  const std::size_t from = text.find_first_not_of(kBlanks);
  return from == std::string_view::npos ? std::string_view() : text.substr(from, text.find_last_not_of(kBlanks) - from + 1);
}

std::vector<std::string_view> split_at_commas(std::string_view text) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    fields.push_back(trimmed(text.substr(at, end - at)));
    at = end + 1;
  }
  return fields;
}

std::vector<std::string_view> split_at_blanks(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = text.find_first_not_of(kBlanks); at != std::string_view::npos; at = text.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

template <typename Number>
std::optional<Number> read(std::string_view word) {
  Number number{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

std::string in_quotes(std::string_view text) { return '"' + std::string(text) + '"'; }

}  // namespace

/// The lines of a text that are neither blank nor start with #, one after the other.
class StateTable::Lines {
 public:
  explicit Lines(std::string_view text) : left_(text) {}

  std::optional<Line> next() {
    while (!left_.empty()) {
      const std::size_t end = std::min(left_.find('\n'), left_.size());
      const std::string_view text = trimmed(left_.substr(0, end));
      left_.remove_prefix(std::min(end + 1, left_.size()));
      ++number_;
      if (!text.empty() && text.front() != '#') return Line{number_, text};
    }
    return std::nullopt;
  }
  unsigned number() const { return number_; }  ///< of the last line

 private:
  std::string_view left_;
  unsigned number_ = 0;
};

StateTable::StateTable(const std::filesystem::path& path) : path_(path), text_(read_file(path)) {
  if (text_.starts_with(kByteOrderMark)) text_.erase(0, kByteOrderMark.size());
  is_dump_ = text_.starts_with("ITEM:");
  Lines lines(text_);
  is_dump_ ? read_dump(lines) : read_csv(lines);
  if (rows_.empty())
    fail(std::max(lines.number(), 1U), "the file has only its head, or nothing; allowed: a line for each grain, bond or part");
}

void StateTable::fail(unsigned line, const std::string& text) const { throw InputError(path_.string(), line, text); }

void StateTable::add_row(const Line& line, std::vector<std::string_view> fields) {
  if (fields.size() != columns_.size()) {
    fail(line.number, "the line has " + std::to_string(fields.size()) + (fields.size() == 1 ? " field" : " fields") +
                          "; allowed: " + std::to_string(columns_.size()) + ", as line " + std::to_string(head_) +
                          " has columns, separated by " + (is_dump_ ? "blanks" : "commas"));
  }
  rows_.push_back({line.number, std::move(fields)});
}

void StateTable::read_csv(Lines& lines) {
  const std::optional<Line> head = lines.next();
  if (!head) return;
  head_ = head->number;
  for (const std::string_view name : split_at_commas(head->text)) {
    if (has(name)) fail(head_, "column " + in_quotes(name) + " occurs twice; allowed: once");
    columns_.emplace_back(name);
  }
  if (columns_.size() == 1) {
    fail(head_, "the line with the names of the columns is " + in_quotes(columns_[0]) +
                    ", without a comma; allowed: columns separated by commas, with points in their numbers");
  }
  while (const std::optional<Line> line = lines.next()) {
    add_row(*line, split_at_commas(line->text));
    if (!has("time_s")) continue;
    const double time = number(rows_.back(), "time_s", Interval::finite("a time, s"));
    if (time_ && time < *time_) {
      rows_.pop_back();
    } else if (time_ && time > *time_) {
      rows_.erase(rows_.begin(), rows_.end() - 1);
    }
    time_ = std::max(time, time_.value_or(time));
  }
}

void StateTable::read_dump(Lines& lines) {
  std::size_t atoms = 0;
  const auto value = [&] {
    const std::optional<Line> line = lines.next();
    return line ? line->text : std::string_view();
  };
  while (const std::optional<Line> line = lines.next()) {
    if (line->text.starts_with("ITEM: ATOMS")) {
      head_ = line->number;
      columns_.clear();
      for (const std::string_view name : split_at_blanks(line->text.substr(std::string_view("ITEM: ATOMS").size()))) {
        const auto known = std::ranges::find(kNamesOfDumps, name, &std::pair<std::string_view, std::string_view>::first);
        columns_.emplace_back(known == kNamesOfDumps.end() ? name : known->second);
      }
      read_frame(lines, atoms);
    } else if (line->text == "ITEM: NUMBER OF ATOMS") {
      const std::optional<std::size_t> number = read<std::size_t>(value());
      if (!number) fail(lines.number(), "the number of atoms is no whole number");
      atoms = *number;
    } else if (line->text == "ITEM: TIME") {
      time_ = read<double>(value());
    } else if (line->text == "ITEM: UNITS") {
      if (const std::string_view units = value(); units != "si") {
        fail(lines.number(), "the units of the dump are " + in_quotes(units) + "; allowed: si");
      }
    }
  }
}

void StateTable::read_frame(Lines& lines, std::size_t atoms) {
  rows_.clear();
  while (rows_.size() < atoms) {
    const std::optional<Line> line = lines.next();
    if (!line || line->text.starts_with("ITEM:")) {
      fail(lines.number(), "the frame ends after " + std::to_string(rows_.size()) + " of " + std::to_string(atoms) + " atoms");
    }
    add_row(*line, split_at_blanks(line->text));
  }
}

bool StateTable::has(std::string_view column) const { return std::ranges::find(columns_, column) != columns_.end(); }

std::size_t StateTable::index_of(std::string_view column) const {
  return static_cast<std::size_t>(std::ranges::find(columns_, column) - columns_.begin());
}

void StateTable::require(const std::vector<std::string>& columns, const std::string& why) const {
  for (const std::string& column : columns) {
    if (has(column)) continue;
    std::string message = "column ";
    message.append(column).append(" is missing").append(why).append("; the columns are ").append(join(columns_));
    fail(head_, message);
  }
}

void StateTable::refuse_others(const std::vector<std::string>& columns) const {
  const auto is_known = [&columns](const std::string& column) { return std::ranges::find(columns, column) != columns.end(); };
  const auto other = std::ranges::find_if_not(columns_, is_known);
  if (other == columns_.end()) return;
  fail(head_, "unknown column " + in_quotes(*other) + did_you_mean(*other, columns) + "; allowed: " + join(columns));
}

std::string_view StateTable::word(const Row& row, std::string_view column) const { return row.fields[index_of(column)]; }

double StateTable::number(const Row& row, std::string_view column, const Interval& allowed) const {
  const std::optional<double> number = read<double>(word(row, column));
  if (number && allowed.contains(*number)) return *number;
  fail(row.line, std::string(column) + " is " + in_quotes(word(row, column)) + "; allowed: " + allowed.describe());
}

std::size_t StateTable::whole_number(const Row& row, std::string_view column, std::size_t least, std::size_t most) const {
  const std::optional<std::size_t> number = read<std::size_t>(word(row, column));
  if (number && *number >= least && *number <= most) return *number;
  fail(row.line, std::string(column) + " is " + in_quotes(word(row, column)) + "; allowed: a whole number from " +
                     std::to_string(least) + " to " + std::to_string(most));
}

}  // namespace falling_particles
