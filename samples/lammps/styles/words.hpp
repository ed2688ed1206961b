// Reads the words of a command in order, and the contact parameters among them.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "kernel/body.hpp"
#include "kernel/contact_material.hpp"
#include "lammps.h"

namespace granular {

/// The unit vector along a finite one. Throws std::invalid_argument, with `keyword`, if all its numbers are 0.
Vector3 direction_of(const std::string& keyword, const Vector3& vector);

/// The remaining words of a command.
class Words {
 public:
  Words(std::span<char*> words, LAMMPS_NS::LAMMPS* lammps) : words_(words), lammps_(lammps) {}

  bool is_empty() const { return words_.empty(); }

  /// The next word. Throws std::invalid_argument, with `keyword`, if there is none.
  std::string next(const std::string& keyword);

  /// Consumes the next word if it equals `word`. Returns whether it did.
  bool accept(const std::string& word);

  /// The next number, which is finite, or the next three. Throws std::invalid_argument, with `keyword`, on any other word.
  double number(const std::string& keyword);
  int integer(const std::string& keyword);
  Vector3 vector(const std::string& keyword);
  /// The unit vector along the next three numbers. Throws std::invalid_argument if all are 0.
  Vector3 direction(const std::string& keyword);

  /// The words before the first of the `separators`. Leaves the separator and the rest.
  Words take_until(std::initializer_list<std::string_view> separators);

 private:
  std::span<char*> words_;
  LAMMPS_NS::LAMMPS* lammps_;
};

/// The parsed parameters.
struct Coefficients {
  bool has_material = false;
  ContactMaterial material;
  bool has_exponents = false;
  double delta = 2, epsilon = 2;
};

/// Parses, in any order,
///     hooke STIFFNESS | hertz YOUNGS_MODULUS POISSON_RATIO, restitution E, friction MU, tangential RATIO, rolling LENGTH,
///     spinning LENGTH, adhesion FORCE, exponents DELTA EPSILON
/// All have defaults except the law. Throws std::invalid_argument with the error.
Coefficients read_coefficients(Words words);

}  // namespace granular
