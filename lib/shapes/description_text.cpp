#include "shapes/description_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include "base/validation.hpp"

namespace supernormal {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";
constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
constexpr std::size_t kExcerpt = 20;  // characters of the text in a message

/// (first, second, third)
template <typename Append>
void append_three(std::string& out, const Append& append) {
  for (int k = 0; k < 3; ++k) {
    out += k == 0 ? "(" : ", ";
    append(k);
  }
  out += ")";
}

/// The number of characters of the finite number that `text` begins with, or 0.
std::size_t read_number(std::string_view text, double& value) {
#ifdef __cpp_lib_to_chars
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // It also reads "inf" and "nan".
  return error == std::errc() && std::isfinite(value) ? static_cast<std::size_t>(end - text.data()) : 0;
#else  // libc++, whose from_chars reads integers alone before version 20
  const std::string_view word = text.substr(0, text.find_first_not_of("+-.0123456789eE"));
  std::istringstream stream{std::string(word)};
  stream.imbue(std::locale::classic());  // a program may have set another, whose numbers have commas
  value = 0;
  const bool is_read = !word.starts_with('+') && (stream >> value || std::fpclassify(value) == FP_SUBNORMAL);  // these fail there
  const bool at_end = stream.eof();
  stream.clear();
  if (!is_read) return 0;
  return at_end ? word.size() : static_cast<std::size_t>(stream.tellg());
#endif
}

}  // namespace

void append_text(std::string& out, double value) { out += value == 0 && std::signbit(value) ? "-0.0" : to_text(value); }

void append_text(std::string& out, const Vector3& vector) {
  append_three(out, [&](int k) { append_text(out, vector[k]); });
}

void append_text(std::string& out, const Matrix3& matrix) {
  append_three(out, [&](int row) { append_text(out, Vector3(matrix.row(row))); });
}

void DescriptionReader::skip_spaces() { next_ = std::min(text_.find_first_not_of(kSpaces, next_), text_.size()); }

std::size_t DescriptionReader::place() {
  skip_spaces();
  return next_ + 1;
}

void DescriptionReader::refuse(std::size_t place, const std::string& expected) const {
  const std::string_view found = text_.substr(place - 1);
  const std::string excerpt(found.substr(0, kExcerpt));
  const char* const more = found.size() > kExcerpt ? "…" : "";
  throw std::invalid_argument("text at character " + std::to_string(place) + " is " +
                              (found.empty() ? "at its end" : "\"" + excerpt + more + "\"") + ", but must be " + expected);
}

void DescriptionReader::expect(std::string_view word) {
  skip_spaces();
  if (!rest().starts_with(word)) refuse(next_ + 1, "\"" + std::string(word) + "\"");
  next_ += word.size();
}

bool DescriptionReader::accept(char character) {
  skip_spaces();
  if (!rest().starts_with(character)) return false;
  ++next_;
  return true;
}

std::string_view DescriptionReader::name(const char* expected) {
  skip_spaces();
  const std::string_view word = rest().substr(0, rest().find_first_not_of(kLetters));
  if (word.empty()) refuse(next_ + 1, expected);
  next_ += word.size();
  return word;
}

double DescriptionReader::number() {
  skip_spaces();
  double value = 0;
  const std::size_t length = read_number(rest(), value);
  if (length == 0) refuse(next_ + 1, "a finite number");
  next_ += length;
  return value;
}

Vector3 DescriptionReader::vector() {
  Vector3 vector;
  for (int k = 0; k < 3; ++k) {
    expect(k == 0 ? "(" : ",");
    vector[k] = number();
  }
  expect(")");
  return vector;
}

Matrix3 DescriptionReader::matrix() {
  Matrix3 matrix;
  for (int row = 0; row < 3; ++row) {
    expect(row == 0 ? "(" : ",");
    matrix.row(row) = vector().transpose();
  }
  expect(")");
  return matrix;
}

void DescriptionReader::end() {
  skip_spaces();
  if (!rest().empty()) refuse(next_ + 1, "at its end");
}

}  // namespace supernormal
