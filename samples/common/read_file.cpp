#include "common/read_file.hpp"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace common {

std::string what_is_no_file(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;  // a path that cannot be examined cannot be opened either
  switch (fs::status(path, ignored).type()) {
    case fs::file_type::directory:
      return "a folder";
    case fs::file_type::fifo:
    case fs::file_type::socket:
      return "a pipe or a socket";
    case fs::file_type::block:
    case fs::file_type::character:
      return "a device";
    default:
      return {};
  }
}

std::string read_file(const std::filesystem::path& path) {
  if (const std::string other = what_is_no_file(path); !other.empty()) {
    throw std::runtime_error("cannot read \"" + path.string() + "\": it is " + other + ", and no file");
  }
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  if (stream && stream.peek() != std::ifstream::traits_type::eof()) bytes << stream.rdbuf();
  if (!stream.is_open() || stream.bad() || bytes.fail()) {
    throw std::runtime_error("cannot read \"" + path.string() + "\": " + std::generic_category().message(errno == 0 ? EIO : errno));
  }
  return bytes.str();
}

}  // namespace common
