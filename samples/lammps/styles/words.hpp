// Reads the words of a command in order.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "kernel/body.hpp"
#include "lammps.h"

namespace granular {

/// The remaining words of a command.
class Words {
 public:
  Words(std::span<char*> words, LAMMPS_NS::LAMMPS* lammps) : words_(words), lammps_(lammps) {}

  bool is_empty() const { return words_.empty(); }

  /// The next word. Throws std::invalid_argument, with `keyword`, if there is none.
  std::string next(const std::string& keyword);

  /// Consumes the next word if it equals `word`. Returns whether it did.
  bool accept(const std::string& word);

  /// The next number, or the next three. LAMMPS ends the program on any other word.
  double number(const std::string& keyword);
  int integer(const std::string& keyword);
  Vector3 vector(const std::string& keyword);

  /// The words before the first of the `separators`. Leaves the separator and the rest.
  Words take_until(std::initializer_list<std::string_view> separators);

 private:
  std::span<char*> words_;
  LAMMPS_NS::LAMMPS* lammps_;
};

}  // namespace granular
