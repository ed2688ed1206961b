#include "shapes/description_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "shapes/validation.hpp"

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
  const auto [end, error] = std::from_chars(rest().data(), rest().data() + rest().size(), value);
  // It also reads "inf" and "nan".
  if (error != std::errc() || !std::isfinite(value)) refuse(next_ + 1, "a finite number");
  next_ += static_cast<std::size_t>(end - rest().data());
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
