// Frames as compact text for pages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "frame.hpp"

namespace falling_particles {

/// Encodes bytes as base 64 (RFC 4648, section 4).
std::string to_base64(std::string_view bytes);

/// Packs numbers into text. Each number is replaced by the difference to its predecessor in a zigzag (0, -1, 1, -2 … are 0, 1, 2, 3
/// …), so that small changes are small numbers. The first bytes of all numbers come first, then the second bytes …, least
/// significant first, so that similar bytes are adjacent. zlib compresses the result. A number with 2 bytes wraps around at 2^16,
/// one with 4 at 2^32.
class Packer {
 public:
  /// Appends as many numbers as `before` has, of `width` (2 or 4) bytes; `before` becomes `numbers`.
  void add(const std::vector<std::uint32_t>& numbers, std::vector<std::uint32_t>& before, unsigned width);
  /// Appends a list. The predecessor of a number is the one before it in the list.
  void add_list(const std::vector<std::uint32_t>& numbers, unsigned width);
  /// The added numbers, compressed, in base 64.
  std::string text() const;

 private:
  void append(const std::vector<std::uint32_t>& differences, unsigned width);

  std::string bytes_;
};

/// The states of all grains so far, frame by frame; x is NaN for removed grains. Each frame is one text of the differences to the
/// frame before, at first to zeros. For all grains it has: x, y, z of the centre (m, bits of a float, 4 bytes); x, y, z, w of the
/// quaternion, times 32767 (2 bytes); velocity (m/s) and angular velocity (rad/s), upper halves of a float's bits (2 bytes: 0.4 %).
class PackedGrains {
 public:
  void add(const Frame& frame);
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  static constexpr std::size_t kFloats = 3, kHalves = 10;

  std::array<std::vector<std::uint32_t>, kFloats + kHalves> before_;  // of each number of a grain
  std::vector<float> orientations_;                                   // of the frame before: x, y, z, w of each grain
  std::vector<std::string> texts_;
};

/// The contacts of as many frames as fit: of every frame, every second, every fourth …, and of the last one. Each frame is one
/// text. For all contacts it has: grains 1 and 2, -1 for a wall (4 bytes); the point, from the centre of grain 1 (of grain 2 if the
/// first is a wall), in `length` / 32767, and the normal, times 32767 (2 bytes); depth (m) and the measured force (N), if any, as
/// upper halves of a float's bits. Numbers are differences to the contact before.
class PackedContacts {
 public:
  /// `budget`: bytes of all texts except the last.
  explicit PackedContacts(std::size_t budget) : budget_(budget) {}
  void add(const Frame& frame);

  struct Packed {
    std::size_t frame;
    std::size_t count;
    double length;  ///< m, the largest coordinate of a point; the unit of the points
    std::string text;
  };
  /// The packed frames in their order.
  std::vector<Packed> texts() const;

 private:
  static Packed pack(const Frame& frame, std::size_t index);

  std::size_t budget_;
  std::size_t frames_ = 0;  // added
  std::size_t stride_ = 1;  // of the kept frames
  std::size_t size_ = 0;    // bytes of kept_
  std::vector<Packed> kept_;
  Packed last_{};
};

}  // namespace falling_particles
