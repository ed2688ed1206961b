// Reads numbers from a fuzzer's bytes, from the front, and zeros after the last byte. The same bytes give the same numbers on every
// machine.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace supernormal::fuzz {

class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : next_(data), end_(data + size) {}

  bool is_empty() const { return next_ == end_; }

  unsigned byte() { return is_empty() ? 0U : *next_++; }

  /// A number in 0 ... count - 1.
  unsigned choice(unsigned count) { return byte() % count; }

  bool flag() { return (byte() & 1U) != 0; }

  std::int32_t integer() {
    std::uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) bits = bits << 8U | byte();
    return static_cast<std::int32_t>(bits);
  }

  /// Any double: eight bytes as they are, a value at which the behaviour changes, or an ordinary value.
  double number() {
    const unsigned kind = byte();
    if (kind < 64) return kEdges[kind % std::size(kEdges)];
    if (kind >= 192) return raw();
    const double size = everyday();
    return kind < 96 ? -size : size;
  }

  /// A number in 1/16 ... 16, about uniform in its logarithm.
  double everyday() { return std::exp2(8 * share() - 4); }

  /// A number in 0 ... 1.
  double share() {
    const unsigned high = byte();
    return (high * 256U + byte()) / 65535.0;
  }

 private:
  // The ends of the valid ranges with both neighbours, and the ends of the number system.
  static constexpr double kEdges[] = {0.0,
                                      -0.0,
                                      1.0,
                                      -1.0,
                                      2.0,
                                      2 - 0x1p-51,
                                      2 + 0x1p-51,
                                      0.5,
                                      std::numeric_limits<double>::infinity(),
                                      -std::numeric_limits<double>::infinity(),
                                      std::numeric_limits<double>::quiet_NaN(),
                                      std::numeric_limits<double>::denorm_min(),
                                      -std::numeric_limits<double>::denorm_min(),
                                      std::numeric_limits<double>::min(),
                                      std::numeric_limits<double>::max(),
                                      -std::numeric_limits<double>::max(),
                                      std::numeric_limits<double>::epsilon(),
                                      1e-30,
                                      1e-30 * (1 - 0x1p-52),
                                      1e-30 * (1 + 0x1p-51),
                                      1e30,
                                      1e30 * (1 - 0x1p-52),
                                      1e30 * (1 + 0x1p-51),
                                      1.01,
                                      1.01 - 0x1p-51,
                                      1.01 + 0x1p-51,
                                      1000.0,
                                      1000 + 0x1p-42,
                                      1000 - 0x1p-42,
                                      1e-9,
                                      1e-15,
                                      1e-16,
                                      1e-100,
                                      1e100,
                                      1e-200,
                                      1e200,
                                      1e-300,
                                      1e300};

  double raw() {
    std::uint64_t bits = 0;
    for (int k = 0; k < 8; ++k) bits = bits << 8U | byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

}  // namespace supernormal::fuzz
