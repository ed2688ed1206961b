#include "packed_frames.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <utility>

namespace falling_particles {
namespace {

constexpr double kWhole = 32767;  // the two-byte integer for 1

std::uint32_t bits_of(double number) { return std::bit_cast<std::uint32_t>(static_cast<float>(number)); }

/// The upper half of a float's bits, rounded to nearest: sign, exponent and 7 digits. A finite number stays finite.
std::uint32_t upper_half(double number) {
  const std::uint32_t bits = bits_of(number);
  constexpr std::uint32_t kLargest = 0x7f7fU;
  return std::min((bits & 0x7fffffffU) + 0x8000U, kLargest << 16U) >> 16U | bits >> 31U << 15U;
}

/// A number in [-1, 1] in two bytes.
std::uint32_t fraction(double number) {
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(std::lround(kWhole * number)));
}

/// The zigzag of a difference that wraps around at 16 or 32 bits.
std::uint32_t zigzag(std::uint32_t difference, unsigned width) {
  const unsigned shift = 32 - 8 * width;
  const auto wrapped = static_cast<std::int32_t>(difference << shift) >> shift;
  return static_cast<std::uint32_t>(wrapped) << 1U ^ static_cast<std::uint32_t>(wrapped >> 31);
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                               bytes.size(), Z_BEST_SPEED);
  if (status != Z_OK) throw std::runtime_error("cannot compress a frame: zlib says " + std::to_string(status));
  packed.resize(size);
  return packed;
}

template <typename Items, typename Number>
std::vector<std::uint32_t> list_of(const Items& items, const Number& number) {
  std::vector<std::uint32_t> numbers;
  numbers.reserve(items.size());
  for (const auto& item : items) numbers.push_back(number(item));
  return numbers;
}

/// m, the contact point relative to the centre of its first grain.
Point from_grain(const Frame& frame, const ContactState& contact) {
  const int grain = contact.grain1 == kWall ? contact.grain2 : contact.grain1;
  const Point& centre = frame.grains[static_cast<std::size_t>(grain)].position;
  return {contact.position[0] - centre[0], contact.position[1] - centre[1], contact.position[2] - centre[2]};
}

/// The largest coordinate (m) of all contact points; 1 if there are none or all are at the centres.
double largest_coordinate(const Frame& frame) {
  double largest = 0;
  for (const ContactState& contact : frame.contacts) {
    for (const double coordinate : from_grain(frame, contact)) largest = std::max(largest, std::abs(coordinate));
  }
  return largest > 0 ? largest : 1;
}

}  // namespace

void Packer::add(const std::vector<std::uint32_t>& numbers, std::vector<std::uint32_t>& before, unsigned width) {
  std::vector<std::uint32_t> differences(numbers.size());
  std::ranges::transform(numbers, before, differences.begin(), std::minus<>());
  append(differences, width);
  before = numbers;
}

void Packer::add_list(const std::vector<std::uint32_t>& numbers, unsigned width) {
  std::vector<std::uint32_t> differences = numbers;
  for (std::size_t k = 1; k < numbers.size(); ++k) differences[k] -= numbers[k - 1];
  append(differences, width);
}

void Packer::append(const std::vector<std::uint32_t>& differences, unsigned width) {
  for (unsigned byte = 0; byte < width; ++byte) {
    for (const std::uint32_t difference : differences) bytes_ += static_cast<char>(zigzag(difference, width) >> 8 * byte & 255U);
  }
}

std::string Packer::text() const { return to_base64(deflated(bytes_)); }

void PackedGrains::add(const Frame& frame) {
  for (std::vector<std::uint32_t>& numbers : before_) numbers.resize(frame.grains.size());
  orientations_.resize(4 * frame.grains.size());
  // Of the two quaternions of an orientation, takes the one nearer to the last: players interpolate between them.
  for (std::size_t k = 0; k < frame.grains.size(); ++k) {
    const auto& [w, x, y, z] = frame.grains[k].quaternion;
    const std::array now = {x, y, z, w};
    double along = 0;
    for (std::size_t i = 0; i < 4; ++i) along += now[i] * orientations_[4 * k + i];
    for (std::size_t i = 0; i < 4; ++i) orientations_[4 * k + i] = static_cast<float>(along < 0 ? -now[i] : now[i]);
  }
  Packer packer;
  std::size_t number = 0;
  const auto add = [&](unsigned width, const auto& of_grain) {
    packer.add(list_of(frame.grains, of_grain), before_[number++], width);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    add(4, [i](const GrainState& grain) { return bits_of(grain.is_present ? grain.position[i] : NAN); });
  }
  for (std::size_t i = 0; i < 4; ++i) {
    add(2, [&](const GrainState& grain) {
      return fraction(orientations_[4 * static_cast<std::size_t>(&grain - frame.grains.data()) + i]);
    });
  }
  for (std::size_t i = 0; i < 3; ++i) add(2, [i](const GrainState& grain) { return upper_half(grain.velocity[i]); });
  for (std::size_t i = 0; i < 3; ++i) add(2, [i](const GrainState& grain) { return upper_half(grain.angular_velocity[i]); });
  texts_.push_back(packer.text());
}

void PackedContacts::add(const Frame& frame) {
  last_ = pack(frame, frames_);
  if (frames_++ % stride_ != 0) return;
  size_ += last_.text.size();
  kept_.push_back(last_);
  while (size_ > budget_ && kept_.size() > 1) {
    stride_ *= 2;
    std::erase_if(kept_, [this](const Packed& packed) { return packed.frame % stride_ != 0; });
    size_ = 0;
    for (const Packed& packed : kept_) size_ += packed.text.size();
  }
}

std::vector<PackedContacts::Packed> PackedContacts::texts() const {
  std::vector<Packed> texts = kept_;
  if (frames_ > 0 && (texts.empty() || texts.back().frame != last_.frame)) texts.push_back(last_);
  return texts;
}

PackedContacts::Packed PackedContacts::pack(const Frame& frame, std::size_t index) {
  const double length = largest_coordinate(frame);
  Packer packer;
  const auto add = [&](unsigned width, const auto& number) { packer.add_list(list_of(frame.contacts, number), width); };
  add(4, [](const ContactState& contact) { return static_cast<std::uint32_t>(contact.grain1); });
  add(4, [](const ContactState& contact) { return static_cast<std::uint32_t>(contact.grain2); });
  for (std::size_t i = 0; i < 3; ++i) {
    add(2, [&, i](const ContactState& contact) { return fraction(from_grain(frame, contact)[i] / length); });
  }
  for (std::size_t i = 0; i < 3; ++i) add(2, [i](const ContactState& contact) { return fraction(contact.normal[i]); });
  add(2, [](const ContactState& contact) { return upper_half(contact.depth); });
  for (std::size_t i = 0; i < 3; ++i) {
    if (frame.contacts.empty() || !frame.contacts[0].force) break;
    add(2, [i](const ContactState& contact) { return upper_half((*contact.force)[i]); });
  }
  return {index, frame.contacts.size(), length, packer.text()};
}

std::string to_base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t start = 0; start < bytes.size(); start += 3) {
    // Three bytes are four digits of six bits. Missing bytes at the end count as zero and are written as '='.
    std::uint32_t bits = 0;
    for (std::size_t i = start; i < start + 3; ++i)
      bits = bits << 8U | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0U);
    for (std::size_t digit = 0; digit < 4; ++digit) {
      const bool is_missing = start + digit > bytes.size();
      text += is_missing ? '=' : kDigits[bits >> (18 - 6 * digit) & 63U];
    }
  }
  return text;
}

}  // namespace falling_particles
