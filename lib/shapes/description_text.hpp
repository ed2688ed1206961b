// Descriptions: numbers, vectors and matrices as text, and back.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "supernormal/shapes/shape.hpp"

namespace supernormal {

/// Appends the shortest text that reads back as the same double. The sign of zero is kept, in Python as well, where -0 is an
/// integer.
void append_text(std::string& out, double value);
void append_text(std::string& out, const Vector3& vector);
void append_text(std::string& out, const Matrix3& matrix);

/// Reads a description word by word. Every function skips spaces and line breaks first. It throws std::invalid_argument with the
/// place and what is expected there if something else follows.
class DescriptionReader {
 public:
  explicit DescriptionReader(std::string_view text) : text_(text) {}

  /// Reads these characters.
  void expect(std::string_view word);

  /// Reads the character if it is next.
  bool accept(char character);

  /// Reads the letters and digits of a name. `expected` names what it should be.
  std::string_view name(const char* expected);

  double number();
  Vector3 vector();
  Matrix3 matrix();

  /// Reads to the end, where nothing but spaces may be.
  void end();

  /// Where the next word begins: 1 for the first character.
  std::size_t place();

  /// Throws: at `place`, `expected` was expected.
  [[noreturn]] void refuse(std::size_t place, const std::string& expected) const;

 private:
  void skip_spaces();
  std::string_view rest() const { return text_.substr(next_); }

  std::string_view text_;
  std::size_t next_ = 0;
};

}  // namespace supernormal
