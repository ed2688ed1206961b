// Frames as short text, for pages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "frame.hpp"

namespace falling_particles {

/// Numbers, packed: of each, the difference to its predecessor in a zigzag (0, -1, 1, -2 … are 0, 1, 2, 3 …), so that small changes
/// are small numbers; of all numbers the first bytes, then the second ones …, least significant first, so that like bytes stand
/// together; the whole compressed by zlib. A number with 2 bytes wraps around at 2^16, one with 4 at 2^32.
class Packer {
 public:
  /// Appends as many numbers as `before` has, of `width` (2 or 4) bytes; `before` becomes `numbers`.
  void add(const std::vector<std::uint32_t>& numbers, std::vector<std::uint32_t>& before, unsigned width);
  /// Appends a list whose numbers each follow the one before.
  void add_list(const std::vector<std::uint32_t>& numbers, unsigned width);
  /// What was added, compressed, in base 64.
  std::string text() const;

 private:
  void append(const std::vector<std::uint32_t>& differences, unsigned width);

  std::string bytes_;
};

/// The states of all bodies that there have been so far, frame by frame, with no number for x of those that are gone. One text a
/// frame, of the differences to the frame before (to zeros at first), each of all bodies: x, y, z of the centre (m, bits of a
/// float, 4 bytes); x, y, z, w of the quaternion, times 32767 (2 bytes); velocity (m/s) and angular velocity (rad/s), the upper
/// halves of a float's bits (2 bytes: 0.4 %).
class PackedGrains {
 public:
  void add(const Frame& frame);
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  static constexpr std::size_t kFloats = 3, kHalves = 10;

  std::array<std::vector<std::uint32_t>, kFloats + kHalves> before_;  // of each number of a body
  std::vector<float> attitudes_;                                      // of the frame before: x, y, z, w of each body
  std::vector<std::string> texts_;
};

/// The contacts, of as many frames as fit: of every frame, of every second, of every fourth …, and of the last one. One text a
/// frame, of all contacts: body 1 and 2, -1 for a wall (4 bytes); point, from the centre of body 1 (of body 2 if that is a wall),
/// in `length` / 32767, and normal, times 32767 (2 bytes); depth (m) and, where it was measured, the force (N), upper halves of a
/// float's bits. But for the last, numbers are differences to those of the contact before.
class PackedContacts {
 public:
  /// `budget`: bytes of all texts, but for the last.
  explicit PackedContacts(std::size_t budget) : budget_(budget) {}
  void add(const Frame& frame);

  struct Packed {
    std::size_t frame;
    std::size_t count;
    double length;  ///< m, the largest coordinate of a point; the unit of the points
    std::string text;
  };
  /// In the order of the frames.
  std::vector<Packed> texts() const;

 private:
  static Packed pack(const Frame& frame, std::size_t index);

  std::size_t budget_;
  std::size_t frames_ = 0;  // added
  std::size_t stride_ = 1;  // of the frames that are kept
  std::size_t size_ = 0;    // bytes of kept_
  std::vector<Packed> kept_;
  Packed last_{};
};

}  // namespace falling_particles
