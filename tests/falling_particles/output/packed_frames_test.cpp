// Tests of the packing of frames, against a second reading of its description.
#include "output/packed_frames.hpp"

#include <doctest/doctest.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string_view>

using namespace falling_particles;

namespace {

std::string from_base64(const std::string& text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  unsigned held = 0;
  for (const char digit : text) {
    if (digit == '=') break;
    bits = bits << 6U | static_cast<std::uint32_t>(kDigits.find(digit));
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 255U);
  }
  return bytes;
}

/// Takes the numbers of a packed text one list after the other.
class Reader {
 public:
  Reader(const std::string& text, std::size_t count) : count_(count), bytes_(1'000'000, '\0') {
    const std::string packed = from_base64(text);
    uLongf size = bytes_.size();
    REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()) == Z_OK);
    bytes_.resize(size);
  }

  std::vector<std::int64_t> differences(unsigned width) {
    std::vector<std::int64_t> numbers(count_);
    for (unsigned byte = 0; byte < width; ++byte) {
      for (std::int64_t& number : numbers)
        number += static_cast<std::int64_t>(static_cast<unsigned char>(bytes_[at_++])) << 8 * byte;
    }
    for (std::int64_t& number : numbers) number = number % 2 == 0 ? number / 2 : -(number + 1) / 2;
    return numbers;
  }
  std::vector<std::uint32_t> list(unsigned width) {
    std::vector<std::uint32_t> numbers;
    std::int64_t sum = 0;
    for (const std::int64_t difference : differences(width)) {
      sum += difference;
      numbers.push_back(static_cast<std::uint32_t>(sum) & (width == 2 ? 0xffffU : 0xffffffffU));
    }
    return numbers;
  }
  bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  std::size_t count_, at_ = 0;
  std::string bytes_;
};

double of_fraction(std::uint32_t number) { return static_cast<std::int16_t>(static_cast<std::uint16_t>(number)) / 32767.0; }
double of_upper_half(std::uint32_t number) { return std::bit_cast<float>(number << 16U); }

GrainState grain_at(double t, double phase) {
  const double half = 2 * t + phase;
  return {{std::sin(t + phase) / 3, 1e3 + t, -1e-7 * phase},
          {std::cos(half), 0, 0.6 * std::sin(half), -0.8 * std::sin(half)},
          {1e-9 * t, -std::cos(phase), 7},
          {300 * t, -1e-30, 0}};
}

Frame noisy_frame(int index) {
  Frame frame;
  for (const double phase : {0.0, 0.5, 1.0, 2.0, 4.0}) frame.grains.push_back(grain_at(0.1 * index, phase));
  return frame;
}

}  // namespace

TEST_CASE("base 64 as in RFC 4648, section 10") {
  CHECK(to_base64("").empty());
  CHECK(to_base64("f") == "Zg==");
  CHECK(to_base64("fo") == "Zm8=");
  CHECK(to_base64("foo") == "Zm9v");
  CHECK(to_base64("foobar") == "Zm9vYmFy");
  CHECK(from_base64(to_base64("\xff\x80 any")) == "\xff\x80 any");
}

TEST_CASE("bodies: positions are floats to the last bit, attitudes fractions, motions within 0.4 %") {
  constexpr int kFrames = 6;
  PackedGrains packed;
  for (int index = 0; index < kFrames; ++index) packed.add(noisy_frame(index));
  REQUIRE(packed.texts().size() == kFrames);
  std::vector<std::vector<std::int64_t>> numbers(13, std::vector<std::int64_t>(5));
  for (int index = 0; index < kFrames; ++index) {
    CAPTURE(index);
    Reader reader(packed.texts()[static_cast<std::size_t>(index)], 5);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::vector<std::int64_t> changes = reader.differences(i < 3 ? 4 : 2);
      for (std::size_t k = 0; k < 5; ++k) numbers[i][k] += changes[k];
    }
    CHECK(reader.is_at_end());
    const Frame frame = noisy_frame(index);
    for (std::size_t k = 0; k < 5; ++k) {
      const GrainState& grain = frame.grains[k];
      const auto number = [&](std::size_t i) { return static_cast<std::uint32_t>(numbers[i][k]); };
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(std::bit_cast<float>(number(i)) == static_cast<float>(grain.position[i]));
        CHECK(of_upper_half(number(7 + i) & 0xffffU) == doctest::Approx(grain.velocity[i]).epsilon(0.004));
        CHECK(of_upper_half(number(10 + i) & 0xffffU) == doctest::Approx(grain.angular_velocity[i]).epsilon(0.004));
      }
      const auto& [w, x, y, z] = grain.quaternion;
      const std::array turned = {x, y, z, w};
      double along = 0;
      for (std::size_t i = 0; i < 4; ++i) along += of_fraction(number(3 + i) & 0xffffU) * turned[i];
      CHECK(std::abs(along) == doctest::Approx(1).epsilon(1e-4));
    }
  }
}

TEST_CASE("bodies that are gone have no number for x, and those that come start from zeros") {
  PackedGrains packed;
  Frame frame;
  frame.grains = {grain_at(0, 0.5)};
  packed.add(frame);
  frame.grains.push_back(grain_at(0, 1));
  packed.add(frame);
  frame.grains[0] = {{}, {1, 0, 0, 0}, {}, {}, false};
  packed.add(frame);
  std::uint32_t gone = 0, come = 0;
  for (std::size_t index = 0; index < 3; ++index) {
    const std::size_t count = index == 0 ? 1 : 2;
    Reader reader(packed.texts()[index], count);
    const std::vector<std::int64_t> changes = reader.differences(4);
    gone += static_cast<std::uint32_t>(changes[0]);
    if (count == 2) come += static_cast<std::uint32_t>(changes[1]);
    for (std::size_t i = 1; i < 13; ++i) reader.differences(i < 3 ? 4 : 2);
    CHECK(reader.is_at_end());
    CHECK(std::isnan(std::bit_cast<float>(gone)) == (index == 2));
  }
  CHECK(std::bit_cast<float>(come) == static_cast<float>(grain_at(0, 1).position[0]));
}

TEST_CASE("attitudes go on smoothly, although q and -q are the same") {
  PackedGrains packed;
  Frame frame;
  frame.grains = {grain_at(0, 0)};
  packed.add(frame);
  for (double& part : frame.grains[0].quaternion) part = -part;
  packed.add(frame);
  Reader reader(packed.texts()[1], 1);
  for (std::size_t i = 0; i < 13; ++i) CHECK(reader.differences(i < 3 ? 4 : 2)[0] == 0);
}

TEST_CASE("a motion that is no float's is the largest number, not an infinite one") {
  PackedGrains packed;
  Frame frame;
  frame.grains = {grain_at(0, 0)};
  frame.grains[0].velocity = {std::numeric_limits<float>::max(), -std::numeric_limits<float>::max(), 0};
  packed.add(frame);
  Reader reader(packed.texts()[0], 1);
  for (std::size_t i = 0; i < 7; ++i) reader.differences(i < 3 ? 4 : 2);
  CHECK(std::isfinite(of_upper_half(static_cast<std::uint32_t>(reader.differences(2)[0]) & 0xffffU)));
  CHECK(std::isfinite(of_upper_half(static_cast<std::uint32_t>(reader.differences(2)[0]) & 0xffffU)));
}

TEST_CASE("contacts: bodies, points from a body, normals, depths and forces") {
  for (const bool has_forces : {false, true}) {
    CAPTURE(has_forces);
    Frame frame = noisy_frame(3);
    const auto force = has_forces ? std::optional(Point{1, -2e-3, 0}) : std::nullopt;
    const Point& centre = frame.grains[2].position;
    frame.contacts = {{{centre[0] + 0.01, centre[1] - 0.02, centre[2]}, {0, 0.6, -0.8}, 1e-6, 2, 4, force},
                      {{centre[0], centre[1], centre[2] + 0.005}, {1, 0, 0}, 3e-4, kWall, 2, force}};
    PackedContacts packed(10'000);
    packed.add(frame);
    REQUIRE(packed.texts().size() == 1);
    const PackedContacts::Packed text = packed.texts()[0];
    CHECK(text.frame == 0);
    REQUIRE(text.count == 2);
    CHECK(text.length == doctest::Approx(0.02));
    Reader reader(text.text, 2);
    CHECK(reader.list(4) == std::vector<std::uint32_t>{2, 0xffffffffU});
    CHECK(reader.list(4) == std::vector<std::uint32_t>{4, 2});
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<std::uint32_t> points = reader.list(2);
      for (std::size_t k = 0; k < 2; ++k) {
        CHECK(std::abs(text.length * of_fraction(points[k]) - (frame.contacts[k].position[i] - centre[i])) < 1e-4 * text.length);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<std::uint32_t> normals = reader.list(2);
      for (std::size_t k = 0; k < 2; ++k) CHECK(std::abs(of_fraction(normals[k]) - frame.contacts[k].normal[i]) < 1e-4);
    }
    const std::vector<std::uint32_t> depths = reader.list(2);
    for (std::size_t k = 0; k < 2; ++k) CHECK(of_upper_half(depths[k]) == doctest::Approx(frame.contacts[k].depth).epsilon(0.004));
    for (std::size_t i = 0; i < 3 && has_forces; ++i) {
      for (const std::uint32_t part : reader.list(2)) CHECK(of_upper_half(part) == doctest::Approx((*force)[i]).epsilon(0.004));
    }
    CHECK(reader.is_at_end());
  }
}

TEST_CASE("contacts of fewer frames are kept when they do not fit, but always those of the last one") {
  Frame frame = noisy_frame(1);
  frame.contacts = {{frame.grains[0].position, {0, 0, 1}, 1e-6, 0, kWall}};
  PackedContacts probe(10'000);
  probe.add(frame);
  const std::size_t size = probe.texts()[0].text.size();
  PackedContacts packed(6 * size);
  for (int index = 0; index < 20; ++index) packed.add(frame);
  std::vector<std::size_t> frames;
  for (const PackedContacts::Packed& text : packed.texts()) frames.push_back(text.frame);
  CHECK(frames == std::vector<std::size_t>{0, 4, 8, 12, 16, 19});
}
