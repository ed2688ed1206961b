// Repeats a query with different contents of the stack. Uninitialized memory must not change an answer.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "supernormal/proximity/proximity.hpp"

namespace supernormal::test {

/// A signalling NaN, as a double and as the second of two floats. With the traps of traps.hpp, computing with it ends the program.
inline constexpr std::uint64_t kSignallingNan = 0x7FF4'0000'7FA0'0000;

/// Possible contents of an uninitialized variable: zeros, a signalling NaN, moderate, huge and tiny numbers, and as an integer a
/// negative one.
inline constexpr std::array<std::uint64_t, 6> kPaints = {0,
                                                         kSignallingNan,
                                                         std::bit_cast<std::uint64_t>(-1.0),
                                                         std::bit_cast<std::uint64_t>(1e300),
                                                         std::bit_cast<std::uint64_t>(-1e-300),
                                                         0xFFFF'FFFF'FFFF'FFFF};

/// Bytes; a query needs less.
inline constexpr std::size_t kPaintedSize = 64 * 1024;

/// Fills the stack below the caller's frame, where the next called functions have their frames.
[[gnu::noinline]] inline void paint_stack(std::uint64_t paint) {
  std::array<volatile std::uint64_t, kPaintedSize / sizeof paint> below;
  for (volatile std::uint64_t& word : below) word = paint;
}

/// All numbers of an answer.
using Numbers = std::vector<double>;

inline Numbers numbers_of(const Proximity& answer) {
  Numbers numbers = {
      answer.gap, answer.error, answer.global_error, double(answer.evaluations), double(answer.status), double(answer.is_global)};
  for (const auto* v : {&answer.normal, &answer.point1, &answer.point2, &answer.contact}) {
    numbers.insert(numbers.end(), v->data(), v->data() + 3);
  }
  return numbers;
}

/// Compares to the bit. Any NaN equals any other NaN, and no number.
inline bool are_identical(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
  }
  return true;
}

/// The answer after the stack has been painted. It is a function of its own, so that the painted part begins at the frame of `ask`.
[[gnu::noinline]] auto ask_on_painted_stack(std::uint64_t paint, const auto& ask) {
  paint_stack(paint);
  return ask();
}

/// Whether ask() gives the same answer over every paint. numbers_of() must be defined for its answers.
bool is_same_on_every_stack(const auto& ask) {
  const Numbers first = numbers_of(ask_on_painted_stack(kPaints[0], ask));
  for (const std::uint64_t paint : kPaints) {
    if (!are_identical(first, numbers_of(ask_on_painted_stack(paint, ask)))) return false;
  }
  return true;
}

}  // namespace supernormal::test
