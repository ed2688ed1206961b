// The words of a command, one after the other.
#pragma once

#include <span>
#include <string>

#include "kernel/body.hpp"
#include "lammps.h"

namespace granular {

/// What is left of a command.
class Words {
 public:
  Words(std::span<char*> words, LAMMPS_NS::LAMMPS* lammps) : words_(words), lammps_(lammps) {}

  bool is_empty() const { return words_.empty(); }

  /// The next word; std::invalid_argument when there is none, with `keyword`, which wanted one.
  std::string next(const std::string& keyword);

  /// Whether the next word is this one, which is then taken.
  bool accept(const std::string& word);

  /// The next one, or the next three, as numbers. LAMMPS ends the program where they are none.
  double number(const std::string& keyword);
  Vector3 vector(const std::string& keyword);

  /// The words before the first one that is `separator`; it and what follows is left.
  Words take_until(const std::string& separator);

 private:
  std::span<char*> words_;
  LAMMPS_NS::LAMMPS* lammps_;
};

}  // namespace granular
