// Lines of a CSV table.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>

#include "common/interval.hpp"

namespace falling_particles {

using namespace common;

/// Builds the lines of a table. Numbers are written as the shortest text that reads back exactly.
class TableText {
 public:
  TableText& add(double value) { return add(std::string_view(shortest(value))); }
  TableText& add(std::size_t value) { return add(std::string_view(std::to_string(value))); }
  TableText& add(const Eigen::Vector3d& v) { return add(v[0]).add(v[1]).add(v[2]); }
  TableText& add(std::string_view field) {
    if (!is_start_) text_ += ',';
    text_ += field;
    is_start_ = false;
    return *this;
  }
  /// Adds empty fields for missing values.
  TableText& blank(int count = 1) {
    for (int i = 0; i < count; ++i) add(std::string_view());
    return *this;
  }
  void end_line() {
    text_ += '\n';
    is_start_ = true;
    ++lines_;
  }

  const std::string& text() const { return text_; }
  std::size_t lines() const { return lines_; }

 private:
  std::string text_;
  std::size_t lines_ = 0;
  bool is_start_ = true;
};

}  // namespace falling_particles
