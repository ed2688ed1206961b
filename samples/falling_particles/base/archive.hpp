// Conversion of values to bytes, and back.
#pragma once

#include <cereal/archives/binary.hpp>
#include <cereal/types/array.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <string>
#include <utility>

namespace falling_particles {

/// Accepts numbers, text, lists and any type that has serialize(archive).
class Writer {
 public:
  template <typename... Values>
  void operator()(const Values&... values) {
    archive_(values...);
  }
  std::string bytes() const { return stream_.str(); }

 private:
  std::ostringstream stream_{std::ios::binary};
  cereal::BinaryOutputArchive archive_{stream_};
};

template <typename... Values>
std::string to_bytes(const Values&... values) {
  Writer writer;
  writer(values...);
  return writer.bytes();
}

/// Returns the values in the same order. Throws std::exception if the bytes end too early.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : stream_(bytes, std::ios::binary) {}
  template <typename... Values>
  void operator()(Values&... values) {
    archive_(values...);
  }
  template <typename Value>
  Value read() {
    Value value{};
    archive_(value);
    return value;
  }

 private:
  std::istringstream stream_;
  cereal::BinaryInputArchive archive_{stream_};
};

}  // namespace falling_particles
